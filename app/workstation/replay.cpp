#include "app/workstation/replay.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "app/core/tracker.h"
#include "app/cycle/cycle.h"
#include "app/telemetry/recorder.h"
#include "app/workstation/output_file.h"
#include "app/workstation/overlay.h"
#include "app/workstation/pose_files.h"
#include "app/workstation/report_file.h"
#include "app/workstation/run_tally.h"
#include "drivers/candump/candump_can_bus.h"
#include "drivers/recorded/no_iris.h"
#include "drivers/recorded/recorded_frame_grabber.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using rtos::AllocationTrap;

void warn(const std::string& line) {
  std::fprintf(stderr, "dottrack: warning: %s\n", line.c_str());
}

Duration period_of(const config::RigConfig& config) {
  return Duration(std::llround(1e9 / config.frame_rate_hz));
}

std::vector<std::string> camera_names(const config::RigConfig& config) {
  std::vector<std::string> names;
  for (const config::CameraEntry& camera : config.cameras) names.push_back(camera.name);
  return names;
}

std::vector<drivers::RecordedCamera> recorded_cameras(const config::RigConfig& config) {
  std::vector<drivers::RecordedCamera> cameras;
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const core::Camera& camera = config.rig.cameras[i];
    cameras.push_back({config.cameras[i].name, camera.width_px, camera.height_px});
  }
  return cameras;
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail(fmt::format("{}: cannot make this folder ({})", folder.string(), error.message()));
}

// Everything that a run is made of, in virtual time and in one thread.
class Run {
 public:
  // What has to be opened first, because it may fail.
  struct Opened {
    config::RigConfig config;
    std::unique_ptr<drivers::RecordedFrameGrabber> grabber;
    OutputFile tum;
    OutputFile csv;
  };

  Run(const ReplayOptions& options, Opened opened, std::unique_ptr<rtos::VirtualClock> clock,
      std::unique_ptr<drivers::CandumpCanBus> can)
      : options_(options),
        opened_(std::move(opened)),
        clock_(std::move(clock)),
        can_(std::move(can)) {
    recorder_.add(tum_);
    recorder_.add(csv_);
    recorder_.add(tally_);
  }

  std::uint64_t recorded_ticks() const { return opened_.grabber->recorded_ticks(); }

  // False when the results can no longer be written.
  bool tick(std::uint64_t tick) {
    for (const std::string& fault : opened_.grabber->load(tick)) warn(fault);
    const rtos::Wake wake = timer_.wait();
    {
      const AllocationTrap::Scope armed;
      cycle_.tick(wake);
      heap_calls_ += armed.calls().total();
    }
    recorder_.drain();
    note(can_->flush());
    if (tally_.first_lock_tick() == static_cast<std::int64_t>(tick)) draw("first_lock");
    return fault_.empty() && !opened_.tum.failed() && !opened_.csv.failed();
  }

  ReplaySummary finish() {
    note(opened_.tum.finish());
    note(opened_.csv.finish());
    const RunFacts facts = {heap_calls_, AllocationTrap::is_complete(),
                            opened_.grabber->bad_frames(), tracker_.footprint_bytes()};
    note(write_file(options_.out / "report.json", report_json(opened_.config, tally_, facts)));
    draw("");
    return summary(facts);
  }

 private:
  void note(const Result<void>& written) {
    if (!written && fault_.empty()) fault_ = written.error().message;
  }

  void draw(const char* folder) {
    if (options_.pictures) note(write_pictures(options_.out / "pictures" / folder));
  }

  // Of the last tick.
  Result<void> write_pictures(const fs::path& folder) const {
    if (auto made = make_folder(folder); !made) return made;
    for (std::size_t i = 0; i < opened_.config.cameras.size(); ++i) {
      const std::string& name = opened_.config.cameras[i].name;
      const Canvas canvas =
          draw_overlay({opened_.grabber->loaded_image(i), name, opened_.config.rig, i,
                        tally_.last_record().result, tracker_.regions(i)});
      const Result<std::string> png = canvas.png();
      if (!png) return tl::unexpected<Error>(png.error());
      if (auto done = write_file(folder / (name + ".png"), *png); !done) return done;
    }
    return {};
  }

  ReplaySummary summary(const RunFacts& facts) const {
    ReplaySummary summary;
    summary.ticks = tally_.ticks();
    summary.tracking_ticks = tally_.tracking_ticks();
    summary.first_lock_tick = tally_.first_lock_tick();
    summary.reacquisitions = tally_.reacquisitions();
    summary.allocations_in_loop = facts.allocations_in_loop;
    summary.bad_frames = facts.bad_frames;
    summary.mean_rms_residual_m = tally_.mean_rms_residual_m();
    summary.last_lock = tally_.last_lock();
    summary.tracker_bytes = facts.tracker_bytes;
    summary.output_fault = fault_;
    return summary;
  }

  ReplayOptions options_;
  Opened opened_;
  std::unique_ptr<rtos::VirtualClock> clock_;
  std::unique_ptr<drivers::CandumpCanBus> can_;
  drivers::NoIris iris_;
  core::Tracker tracker_{opened_.config.rig};
  rtos::VirtualPeriodicTimer timer_{*clock_, Time{}, period_of(opened_.config)};
  rtos::MonotonicClock stopwatch_;
  std::unique_ptr<telemetry::RecordRing> ring_ = std::make_unique<telemetry::RecordRing>();
  cycle::Cycle cycle_{
      {*opened_.grabber, iris_, *can_, tracker_, *clock_, stopwatch_, *ring_},
      cycle::settings_for(opened_.config.cameras.size(), period_of(opened_.config))};
  telemetry::Recorder recorder_{*ring_};
  TumWriter tum_{opened_.tum};
  CsvWriter csv_{opened_.csv, camera_names(opened_.config), opened_.config.rig.target.dots.size()};
  RunTally tally_;
  std::uint64_t heap_calls_ = 0;
  std::string fault_;
};

Result<std::unique_ptr<Run>> open_run(const ReplayOptions& options) {
  Result<config::RigConfig> config = config::load_rig(options.rig);
  if (!config) return tl::unexpected<Error>(config.error());
  auto grabber = drivers::RecordedFrameGrabber::open(options.frames, recorded_cameras(*config));
  if (!grabber) return tl::unexpected<Error>(grabber.error());
  for (const std::string& name : (*grabber)->silent_cameras()) {
    warn(fmt::format("{} holds no images; {} will not deliver", (options.frames / name).string(),
                     name));
  }
  if (const auto made = make_folder(options.out); !made) return tl::unexpected<Error>(made.error());
  Result<OutputFile> tum = OutputFile::create(options.out / "poses.tum");
  if (!tum) return tl::unexpected<Error>(tum.error());
  Result<OutputFile> csv = OutputFile::create(options.out / "poses.csv");
  if (!csv) return tl::unexpected<Error>(csv.error());
  auto clock = std::make_unique<rtos::VirtualClock>();
  auto can = drivers::CandumpCanBus::open(options.out / "can.log", *clock);
  if (!can) return tl::unexpected<Error>(can.error());
  Run::Opened opened{std::move(*config), std::move(*grabber), std::move(*tum), std::move(*csv)};
  return std::make_unique<Run>(options, std::move(opened), std::move(clock), std::move(*can));
}

}  // namespace

Result<ReplaySummary> replay(const ReplayOptions& options) {
  if (options.repeat < 1) return fail("--repeat is at least 1");
  Result<std::unique_ptr<Run>> run = open_run(options);
  if (!run) return tl::unexpected<Error>(run.error());
  const std::uint64_t ticks =
      (*run)->recorded_ticks() + static_cast<std::uint64_t>(options.repeat) - 1;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    if (!(*run)->tick(tick)) break;
  }
  return (*run)->finish();
}

}  // namespace dottrack::workstation
