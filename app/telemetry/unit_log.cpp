#include "app/telemetry/unit_log.h"

#include <fmt/format.h>

#include <utility>

namespace dottrack::telemetry {
namespace {

constexpr std::uint64_t kTicksBetweenLosses = 100;

std::string_view words_of(hal::CanState state) {
  switch (state) {
    case hal::CanState::active:
      return "in good order";
    case hal::CanState::warning:
      return "many errors";
    case hal::CanState::passive:
      return "error passive: nobody acknowledges, or the bus is disturbed";
    case hal::CanState::bus_off:
      return "bus off";
    case hal::CanState::absent:
      return "interface down or gone";
  }
  return "unknown";
}

std::uint64_t unsent(const CycleCounters& counters) {
  return counters.sends_failed + counters.sends_without_room;
}

}  // namespace

UnitLog::UnitLog(std::vector<std::string> cameras, LogLine log)
    : cameras_(std::move(cameras)), log_(std::move(log)) {}

void UnitLog::do_write(const CycleRecord& record) {
  ++ticks_;
  note_state(record.result);
  note_cameras(record.result);
  note_moved(record.result);
  note_can_state(record.can_state);
  note_can(record.counters);
  note_irises(record.unhealthy_irises);
  note_losses(record.counters);
  note_commands(record.counters.commands);
}

void UnitLog::note_state(const core::TickResult& result) {
  const bool found = state_ != core::State::tracking && result.state == core::State::tracking;
  const bool lost = state_ == core::State::tracking && result.state != core::State::tracking;
  state_ = result.state;
  reason_ = result.reason;
  if (found) {
    log_(Severity::info, fmt::format("lock {}: {} dots, {} cameras", result.reset_count,
                                     result.dots_used, result.cameras_used.size()));
  } else if (lost) {
    log_(Severity::warning, fmt::format("lock {} lost: {}; acquiring again", result.reset_count,
                                        core::to_string(result.reason)));
  }
}

void UnitLog::note_cameras(const core::TickResult& result) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (result.cameras[i].delivered) {
      if (away_.contains(i)) log_(Severity::info, fmt::format("camera {}: is back", cameras_[i]));
      away_.erase(i);
      ticks_away_[i] = 0;
    } else if (++ticks_away_[i] == kTicksAway) {
      log_(Severity::warning, fmt::format("camera {}: delivers no images", cameras_[i]));
      away_.insert(i);
    }
  }
}

void UnitLog::note_moved(const core::TickResult& result) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const core::CameraTick& camera = result.cameras[i];
    if (!camera.moved) {
      shift_px_[i] = camera.shift_px.norm();
      if (moved_.contains(i))
        log_(Severity::info, fmt::format("camera {}: counts again", cameras_[i]));
      moved_.erase(i);
    } else if (!moved_.contains(i)) {
      moved_.insert(i);
      log_(Severity::warning,
           fmt::format("camera {}: has been moved, its dots are {:.2f} pixels off; left out until "
                       "its model is repaired and the unit is started again",
                       cameras_[i], shift_px_[i]));
    }
  }
  if (result.rig_disagrees && !rig_disagrees_) {
    log_(
        Severity::warning,
        "more cameras contradict each other than can be left out: check the target and the models");
  }
  rig_disagrees_ = result.rig_disagrees;
}

void UnitLog::note_can_state(hal::CanState state) {
  if (state == can_state_) return;
  can_state_ = state;
  const bool good = state == hal::CanState::active;
  log_(good ? Severity::info : Severity::warning, fmt::format("CAN: {}", words_of(state)));
}

void UnitLog::note_can(const CycleCounters& counters) {
  const bool went_out = counters.messages_sent > counters_.messages_sent;
  const bool stayed = unsent(counters) > unsent(counters_);
  if (!can_silent_ && stayed) {
    can_silent_ = true;
    unsent_at_silence_ = unsent(counters_);
    log_(Severity::warning, "CAN: pose frames do not go out");
  } else if (can_silent_ && went_out) {
    can_silent_ = false;
    log_(Severity::info, fmt::format("CAN: pose frames go out again, {} messages were lost",
                                     unsent(counters) - unsent_at_silence_));
  }
}

void UnitLog::note_irises(CameraSet unhealthy) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (unhealthy.contains(i) == unhealthy_irises_.contains(i)) continue;
    if (unhealthy.contains(i)) {
      log_(Severity::warning, fmt::format("iris of {}: is not where it was sent", cameras_[i]));
    } else {
      log_(Severity::info, fmt::format("iris of {}: answers again", cameras_[i]));
    }
  }
  unhealthy_irises_ = unhealthy;
}

// Losses come in bursts; one line tells of many.
void UnitLog::note_losses(const CycleCounters& counters) {
  counters_ = counters;
  const std::uint64_t missed = counters.deadline_misses - told_.deadline_misses;
  const std::uint64_t dropped = counters.records_dropped - told_.records_dropped;
  const bool soon = ticks_of_last_loss_ > 0 && ticks_ - ticks_of_last_loss_ < kTicksBetweenLosses;
  if ((missed == 0 && dropped == 0) || soon) return;
  ticks_of_last_loss_ = ticks_;
  told_ = counters;
  if (missed > 0) log_(Severity::warning, fmt::format("{} ticks were missed", missed));
  if (dropped > 0) log_(Severity::warning, fmt::format("{} records were dropped", dropped));
}

// Those carried out come a second apart at most; a flood of refused ones is one line.
void UnitLog::note_commands(const protocol::CommandCounts& commands) {
  const std::uint64_t done = commands.accepted - told_commands_.accepted;
  const std::uint64_t refused = commands.rejected - told_commands_.rejected;
  const std::uint64_t corrupted = commands.corrupted - told_commands_.corrupted;
  const bool soon =
      ticks_of_last_command_ > 0 && ticks_ - ticks_of_last_command_ < kTicksBetweenLosses;
  if (done + refused + corrupted == 0 || (done == 0 && soon)) return;
  ticks_of_last_command_ = ticks_;
  told_commands_ = commands;
  log_(refused + corrupted > 0 ? Severity::warning : Severity::info,
       fmt::format("commands over CAN: {} carried out, {} refused, {} corrupted", done, refused,
                   corrupted));
}

std::string UnitLog::names_of(CameraSet cameras) const {
  std::string names;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (cameras.contains(i)) names += (names.empty() ? "" : ", ") + cameras_[i];
  }
  return names;
}

std::string UnitLog::status() const {
  std::string text(core::to_string(state_));
  if (reason_ != core::Reason::none) text += fmt::format(" ({})", core::to_string(reason_));
  text += fmt::format(", {} of {} cameras",
                      cameras_.size() - static_cast<std::size_t>(away_.size()), cameras_.size());
  if (!away_.empty()) text += fmt::format(" (without {})", names_of(away_));
  if (!moved_.empty()) text += fmt::format(", {} moved", names_of(moved_));
  if (rig_disagrees_) text += ", cameras disagree";
  if (!unhealthy_irises_.empty())
    text += fmt::format(", irises of {} stuck", names_of(unhealthy_irises_));
  if (can_state_ != hal::CanState::active) text += fmt::format(", CAN {}", words_of(can_state_));
  if (can_silent_) text += ", CAN silent";
  return text + fmt::format(", {} ticks, {} missed", ticks_, counters_.deadline_misses);
}

}  // namespace dottrack::telemetry
