#include "app/workstation/loop_run.h"

#include <cmath>
#include <utility>
#include <vector>

#include "app/config/broadcast.h"
#include "app/config/light.h"
#include "app/workstation/overlay.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using rtos::AllocationTrap;

std::vector<std::string> camera_names(const config::RigConfig& config) {
  std::vector<std::string> names;
  for (const config::CameraEntry& camera : config.cameras) names.push_back(camera.name);
  return names;
}

}  // namespace

Duration period_of(const config::RigConfig& config) {
  return Duration(std::llround(1e9 / config.frame_rate_hz));
}

LoopRun::LoopRun(const config::RigConfig& config, LoopFiles files, LoopHardware hardware)
    : config_(config),
      files_(std::move(files)),
      hardware_(std::move(hardware)),
      tracker_(config_.rig),
      light_(config_.rig, config::light_settings(config_)),
      timer_(*files_.clock, Time{}, period_of(config_)),
      ring_(std::make_unique<telemetry::RecordRing>()),
      cycle_({.grabber = hardware_.grabber,
              .iris = hardware_.iris,
              .can = hardware_.can,
              .tracker = tracker_,
              .clock = *files_.clock,
              .stopwatch = stopwatch_,
              .records = *ring_,
              .light = &light_},
             cycle::settings_for(config_.rig, period_of(config_),
                                 config::broadcast_settings(config_))),
      recorder_(*ring_),
      tum_(files_.tum),
      filtered_tum_(files_.filtered_tum),
      csv_(files_.csv, camera_names(config_), config_.rig.target.dots.size()) {
  recorder_.add(tum_);
  recorder_.add(filtered_tum_);
  recorder_.add(csv_);
  recorder_.add(tally_);
}

bool LoopRun::tick() {
  const rtos::Wake wake = timer_.wait();
  {
    const AllocationTrap::Scope armed;
    cycle_.tick(wake);
    heap_calls_ += armed.calls().total();
  }
  const bool locked_before = tally_.first_lock_tick() >= 0;
  recorder_.drain();
  note(files_.can_log->flush());
  if (!locked_before && tally_.first_lock_tick() >= 0) draw("first_lock");
  return fault_.empty() && !files_.tum.failed() && !files_.filtered_tum.failed() &&
         !files_.csv.failed();
}

void LoopRun::draw(const fs::path& folder) {
  if (hardware_.image) note(write_pictures(files_.out / "pictures" / folder));
}

RunSummary LoopRun::finish(RunFacts facts) {
  note(files_.tum.finish());
  note(files_.filtered_tum.finish());
  note(files_.csv.finish());
  facts.allocations_in_loop = heap_calls_;
  facts.allocation_trap_complete = AllocationTrap::is_complete();
  facts.tracker_bytes = tracker_.footprint_bytes();
  note(telemetry::write_file(files_.out / "report.json", report_json(config_, tally_, facts)));
  draw("");
  return summary(facts);
}

void LoopRun::note(const Result<void>& written) {
  if (!written && fault_.empty()) fault_ = written.error().message;
}

Result<void> LoopRun::write_pictures(const fs::path& folder) const {
  if (auto made = make_folder(folder); !made) return made;
  for (std::size_t i = 0; i < config_.cameras.size(); ++i) {
    const std::string& name = config_.cameras[i].name;
    const Canvas canvas =
        draw_overlay({hardware_.image(i), name, config_.rig, i, tally_.last_record().result,
                      tracker_.regions(i), &tally_.last_record().light[i]});
    const Result<std::string> png = canvas.png();
    if (!png) return tl::unexpected<Error>(png.error());
    if (auto done = telemetry::write_file(folder / (name + ".png"), *png); !done) return done;
  }
  return {};
}

RunSummary LoopRun::summary(const RunFacts& facts) const {
  RunSummary summary;
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

}  // namespace dottrack::workstation
