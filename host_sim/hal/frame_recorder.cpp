#include "host_sim/hal/frame_recorder.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <utility>

#include "host_sim/scenarios/scene_files.h"

namespace dottrack::host_sim {
namespace {

namespace fs = std::filesystem;

bool is_frame(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool digits = stem.size() == 6 && stem.find_first_not_of("0123456789") == std::string::npos;
  return digits && file.extension() == ".pgm";
}

Result<void> empty_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return fail(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  }
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_frame(entry.path())) frames.push_back(entry.path());
  }
  for (const fs::path& frame : frames) {
    if (!error) fs::remove(frame, error);
  }
  if (!error) return {};
  return fail(fmt::format("{}: cannot remove an older recording's frames: {}", folder.string(),
                          error.message()));
}

}  // namespace

FrameRecorder::FrameRecorder(fs::path folder, std::vector<std::string> cameras)
    : folder_(std::move(folder)), cameras_(std::move(cameras)) {}

Result<std::unique_ptr<FrameRecorder>> FrameRecorder::open(const fs::path& folder,
                                                           std::vector<std::string> cameras) {
  std::unique_ptr<FrameRecorder> recorder(new FrameRecorder(folder, std::move(cameras)));
  for (const std::string& camera : recorder->cameras_) {
    if (auto made = empty_folder(folder / camera); !made) {
      return tl::unexpected<Error>(made.error());
    }
  }
  recorder->times_.open(folder / "times.csv", std::ios::binary | std::ios::trunc);
  recorder->times_ << "tick,camera,mid_exposure_ns,arrival_ns\n";
  if (recorder->times_) return recorder;
  return fail(fmt::format("{}: cannot write the file", (folder / "times.csv").string()));
}

Result<void> FrameRecorder::record(std::uint64_t tick, const SimFrameGrabber& grabber) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!grabber.delivered().contains(i)) continue;
    const fs::path file = folder_ / cameras_[i] / fmt::format("{:06}.pgm", tick);
    if (auto done = write_pgm(file, grabber.picture(i)); !done) return done;
    times_ << fmt::format("{},{},{},{}\n", tick, cameras_[i],
                          grabber.mid_exposure(i).time_since_epoch().count(),
                          grabber.arrival(i).time_since_epoch().count());
  }
  return {};
}

Result<void> FrameRecorder::finish() {
  times_.close();
  if (times_) return {};
  return fail(fmt::format("{}: cannot write the file", (folder_ / "times.csv").string()));
}

}  // namespace dottrack::host_sim
