#include "app/telemetry/recording.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace dottrack::telemetry {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kTicksBetweenTries = 30;
constexpr std::uint64_t kMaxFrames = 1'000'000;  // as many as six digits count

Result<fs::path> next_run(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    for (int number = 1; number < 1'000'000; ++number) {
      const fs::path run = folder / fmt::format("run-{:06}", number);
      if (fs::create_directory(run, error)) return run;
      if (error) break;
    }
  }
  return fail(fmt::format("{}: cannot make a folder there ({})", folder.string(), error.message()));
}

}  // namespace

struct Recording::Run {
  fs::path folder;
  OutputFile tum_file;
  OutputFile csv_file;
  TumWriter tum{tum_file};
  CsvWriter csv;
  std::unique_ptr<FrameWriter> frames;
  std::uint64_t frames_written = 0;

  Run(fs::path where, OutputFile t, OutputFile c, const RecordingSettings& settings)
      : folder(std::move(where)),
        tum_file(std::move(t)),
        csv_file(std::move(c)),
        csv(csv_file, settings.cameras, settings.dots) {}
};

std::optional<std::uint64_t> free_bytes(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error) return std::nullopt;
  return space.available;
}

Recording::Recording(RecordingSettings settings, FrameRing* frames, FreeSpace free_space)
    : settings_(std::move(settings)), frames_(frames), free_space_(std::move(free_space)) {}

Recording::~Recording() {
  stop("ended");
}

void Recording::do_write(const CycleRecord& record) {
  if (!ready()) {
    ++lost_ticks_;
    return;
  }
  run_->tum.write(record);
  run_->csv.write(record);
}

void Recording::settle() {
  while (const FrameCopy* copy = frames_ == nullptr ? nullptr : frames_->front()) {
    write_frames(*copy);
    frames_->pop();
  }
  if (!run_) return;
  for (OutputFile* file : {&run_->tum_file, &run_->csv_file}) {
    if (auto done = file->flush(); !done) return stop(done.error().message);
  }
}

void Recording::write_frames(const FrameCopy& copy) {
  if (!run_ || !run_->frames || no_room()) {
    ++lost_frames_;
    return;
  }
  if (auto done = run_->frames->write(run_->frames_written++, copy); !done) {
    ++lost_frames_;
    stop(done.error().message);
  } else if (run_->frames_written == kMaxFrames) {
    stop("the next run begins");
    ticks_until_retry_ = 0;
  }
}

// Starts a run where there is none and it is time to try again.
bool Recording::ready() {
  if (run_) {
    if (const auto why = no_room()) stop(*why);
    return run_ != nullptr;
  }
  if (ticks_until_retry_ > 0) {
    --ticks_until_retry_;
    return false;
  }
  const auto why = no_room();
  const Result<void> started = why ? Result<void>(fail(*why)) : start();
  if (started) {
    fault_.clear();
    return true;
  }
  stop(started.error().message);
  return false;
}

Result<void> Recording::start() {
  const Result<fs::path> folder = next_run(settings_.folder);
  if (!folder) return tl::unexpected<Error>(folder.error());
  Result<OutputFile> tum = OutputFile::create(*folder / "poses.tum");
  if (!tum) return tl::unexpected<Error>(tum.error());
  Result<OutputFile> csv = OutputFile::create(*folder / "poses.csv");
  if (!csv) return tl::unexpected<Error>(csv.error());
  auto run = std::make_unique<Run>(*folder, std::move(*tum), std::move(*csv), settings_);
  if (settings_.frames) {
    auto frames = FrameWriter::open(*folder / "frames", settings_.cameras);
    if (!frames) return tl::unexpected<Error>(frames.error());
    run->frames = std::move(*frames);
  }
  run_ = std::move(run);
  return {};
}

void Recording::stop(std::string why) {
  fault_ = std::move(why);
  ticks_until_retry_ = kTicksBetweenTries;
  if (!run_) return;
  // Each file by itself: one that fails must not take the others with it.
  static_cast<void>(run_->tum_file.finish());
  static_cast<void>(run_->csv_file.finish());
  if (run_->frames) static_cast<void>(run_->frames->finish());
  run_.reset();
}

std::optional<std::string> Recording::no_room() const {
  const fs::path& where = run_ ? run_->folder : settings_.folder;
  const auto free = free_space_(where);
  if (!free || *free >= settings_.min_free_bytes) return std::nullopt;
  return fmt::format("{}: the disk is full, {} MB free; expected at least {} MB",
                     settings_.folder.string(), *free / 1'000'000,
                     settings_.min_free_bytes / 1'000'000);
}

}  // namespace dottrack::telemetry
