#include "app/firmware/housekeeping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

#include "app/firmware/journal.h"
#include "app/firmware/losses.h"

namespace dottrack::firmware {
namespace {

using telemetry::Severity;

constexpr std::chrono::milliseconds kRound{100};
constexpr std::uint64_t kRoundsAStatus = 10;
constexpr std::uint64_t kRoundsALosses = 600;       // a minute
constexpr std::uint64_t kRoundsAReminder = 36'000;  // an hour

std::vector<std::string> camera_names(const config::RigConfig& config) {
  std::vector<std::string> names;
  for (const config::CameraEntry& camera : config.cameras) names.push_back(camera.name);
  return names;
}

telemetry::RecordingSettings recording_settings(const config::RigConfig& config) {
  const config::RecordingConfig& recording = *config.unit.recording;
  return {.folder = recording.folder,
          .frames = recording.frames,
          .min_free_bytes = static_cast<std::uint64_t>(recording.min_free_mb * 1e6),
          .cameras = camera_names(config),
          .dots = config::most_dots(config)};
}

}  // namespace

Housekeeping::Housekeeping(Unit& unit, const rtos::ServiceManager& manager,
                           const Degradation& degradation, ContinuityFile& locks,
                           telemetry::RecordWriter* also)
    : unit_(unit),
      manager_(manager),
      degradation_(degradation),
      locks_(locks),
      log_(camera_names(unit.config()), log_line),
      recorder_(unit.records()) {
  recorder_.add(log_);
  if (unit.config().unit.recording) {
    recording_.emplace(recording_settings(unit.config()), unit.frames());
    recorder_.add(*recording_);
  }
  if (also != nullptr) recorder_.add(*also);
}

Housekeeping::~Housekeeping() {
  ending_ = true;
  thread_.join();
  round();
}

Result<void> Housekeeping::start() {
  return thread_.start({.name = "dottrack-keep"}, [this] { run(); });
}

void Housekeeping::run() {
  while (!ending_) {
    round();
    std::this_thread::sleep_for(kRound);
  }
}

void Housekeeping::round() {
  recorder_.drain();
  if (recording_) recording_->settle();
  // The thread that waits for signals is the one that exchanges targets.
  if (unit_.requests().pending()) ::kill(::getpid(), SIGUSR1);
  if (rounds_++ % kRoundsAStatus != 0) return;
  report_recording();
  report_heap();
  keep_locks();
  if (rounds_ % kRoundsALosses == 1) report_losses();
  manager_.status(status());
  if (rounds_ % kRoundsAReminder == 1) {
    for (const std::string& lack : degradation_.lacks()) {
      log_line(Severity::warning, "degraded: " + lack);
    }
  }
  // A loop that has stopped turning is what the service manager must hear nothing of.
  const std::uint64_t ticks = unit_.ticks();
  if (ticks != ticks_at_last_kick_) manager_.kick();
  ticks_at_last_kick_ = ticks;
}

void Housekeeping::report_recording() {
  if (!recording_ || recording_->fault() == told_recording_fault_) return;
  told_recording_fault_ = recording_->fault();
  if (told_recording_fault_.empty()) {
    log_line(Severity::info,
             fmt::format("recording again; {} ticks were not recorded", recording_->lost_ticks()));
  } else {
    log_line(Severity::warning, "not recording: " + told_recording_fault_);
  }
}

void Housekeeping::report_heap() {
  const std::uint64_t heap_calls = unit_.heap_calls();
  if (heap_calls > told_heap_calls_) {
    log_line(Severity::error, fmt::format("{} heap calls in the loop", heap_calls));
  }
  told_heap_calls_ = heap_calls;
}

// A frame lost now and then is no news by itself; a minute's losses are one line a device.
void Housekeeping::report_losses() {
  const auto& cameras = unit_.config().cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const drivers::CameraHealth health = unit_.hardware().cameras->health(i);
    if (const auto line = losses(cameras[i].name, told_cameras_[i], health)) {
      log_line(Severity::warning, *line);
    }
    told_cameras_[i] = health;
  }
  const drivers::SocketCanCounts can = unit_.hardware().can->counts();
  if (const auto line = losses(told_can_, can)) log_line(Severity::warning, *line);
  told_can_ = can;
}

void Housekeeping::keep_locks() {
  const auto kept = locks_.keep(unit_.resets());
  if (!kept && !told_locks_fault_) log_line(Severity::warning, kept.error().message);
  told_locks_fault_ = !kept;
}

std::string Housekeeping::status() const {
  std::string text = log_.status();
  if (recording_ && !recording_->fault().empty()) {
    text += fmt::format(", not recording ({} ticks lost)", recording_->lost_ticks());
  } else if (recording_ && recording_->lost_ticks() + recording_->lost_frames() > 0) {
    text += fmt::format(", recording ({} ticks lost)", recording_->lost_ticks());
  }
  if (!degradation_.lacks().empty()) {
    text += fmt::format(", degraded: {}", fmt::join(degradation_.lacks(), "; "));
  }
  return text;
}

}  // namespace dottrack::firmware
