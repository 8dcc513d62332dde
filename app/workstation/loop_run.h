#pragma once
// The loop as the board runs it, in virtual time and in one thread, with all that it leaves behind:
// poses.tum, poses.csv, can.log, report.json and pictures.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "app/config/rig_file.h"
#include "app/core/exposure/light_control.h"
#include "app/core/tracker.h"
#include "app/cycle/cycle.h"
#include "app/telemetry/pose_files.h"
#include "app/telemetry/recorder.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/report_file.h"
#include "app/workstation/run_summary.h"
#include "app/workstation/run_tally.h"
#include "hal/base/image_view.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"

namespace dottrack::workstation {

struct LoopHardware {
  hal::FrameGrabber& grabber;
  hal::Iris& iris;
  hal::CanBus& can;
  // A camera's image of the last tick, for pictures; empty when it did not deliver. Empty function:
  // no pictures are drawn.
  std::function<ImageView(std::size_t)> image;
};

// The instant of a tick, and from one to the next.
Duration period_of(const config::RigConfig& config);

class LoopRun {
 public:
  // The hardware outlives this.
  LoopRun(const config::RigConfig& config, LoopFiles files, LoopHardware hardware);

  // Every record from now on also goes to this writer.
  void add(telemetry::RecordWriter& writer) { recorder_.add(writer); }

  // The next tick. False when the results can no longer be written.
  bool tick();

  const RunTally& tally() const { return tally_; }

  // Overlay pictures of the last tick into OUT/pictures/`folder`.
  void draw(const std::filesystem::path& folder);

  // Completes the files. `facts` as far as the caller knows them; what the loop knows is filled in.
  RunSummary finish(RunFacts facts);

 private:
  void note(const Result<void>& written);
  Result<void> write_pictures(const std::filesystem::path& folder) const;
  RunSummary summary(const RunFacts& facts) const;

  config::RigConfig config_;
  LoopFiles files_;
  LoopHardware hardware_;
  core::Tracker tracker_;
  exposure::LightControl light_;
  rtos::VirtualPeriodicTimer timer_;
  rtos::MonotonicClock stopwatch_;
  std::unique_ptr<telemetry::RecordRing> ring_;
  cycle::Cycle cycle_;
  telemetry::Recorder recorder_;
  telemetry::TumWriter tum_;
  telemetry::FilteredTumWriter filtered_tum_;
  telemetry::CsvWriter csv_;
  RunTally tally_;
  std::uint64_t heap_calls_ = 0;
  std::string fault_;
};

}  // namespace dottrack::workstation
