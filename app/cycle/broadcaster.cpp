#include "app/cycle/broadcaster.h"

#include "app/core/protocol/light_message.h"

namespace dottrack::cycle {
namespace {

constexpr int kMostFramesHeard = 8;  // a tick

}  // namespace

bool Broadcaster::tell(protocol::PoseMessage message, Time deadline,
                       telemetry::CycleCounters& counters) {
  message.degraded = protocol::DegradedSet(message.degraded.bits() | settings_.standing.bits());
  const auto parts = plan_.next(announcement_of(message));
  if (!parts) return false;
  const bool whole = send_group(message, *parts, deadline, counters);
  plan_.sent_whole(whole);
  if (whole && (plan_.identity_due() || identity_wanted_)) send_identity(deadline, counters);
  ++sequence_;
  return true;
}

void Broadcaster::tell_light(std::span<const exposure::CameraLight> cameras, Time deadline,
                             telemetry::CycleCounters& counters) {
  if (cameras.empty() || !plan_.light_due()) return;
  const std::size_t camera = lit_camera_ % cameras.size();
  const auto frame = protocol::encode_light(static_cast<std::uint8_t>(camera), cameras[camera],
                                            settings_.addressing, lights_++);
  if (send(frame, deadline, counters)) lit_camera_ = camera + 1;
}

void Broadcaster::part(const protocol::PoseMessage& message, Time deadline,
                       telemetry::CycleCounters& counters) {
  send_group(message, {}, deadline, counters);
  ++sequence_;
}

void Broadcaster::identify_as(const protocol::IdentityMessage& identity) {
  settings_.identity = identity;
  identity_wanted_ = true;
}

bool Broadcaster::send(const hal::CanFrame& frame, Time deadline,
                       telemetry::CycleCounters& counters) {
  const hal::SendResult sent = can_.send(frame, deadline);
  if (sent == hal::SendResult::accepted) return true;
  ++(sent == hal::SendResult::try_again ? counters.sends_without_room : counters.sends_failed);
  return false;
}

// A group that is cut short is of no use to anyone: after the first frame that does not go out, the
// others stay at home.
bool Broadcaster::send_group(const protocol::PoseMessage& message,
                             const protocol::GroupParts& parts, Time deadline,
                             telemetry::CycleCounters& counters) {
  protocol::encode_group(message, parts, settings_.addressing, sequence_, frames_);
  for (const hal::CanFrame& frame : frames_) {
    if (!send(frame, deadline, counters)) return false;
  }
  ++counters.messages_sent;
  return true;
}

void Broadcaster::send_identity(Time deadline, telemetry::CycleCounters& counters) {
  identity_wanted_ = false;
  for (const hal::CanFrame& frame :
       protocol::encode_identity(settings_.identity, settings_.addressing, sequence_)) {
    identity_wanted_ = !send(frame, deadline, counters) || identity_wanted_;
  }
}

std::optional<protocol::Command> Broadcaster::listen(Time now, Time deadline) {
  if (!settings_.commands) return std::nullopt;
  hal::CanFrame frame;
  for (int heard = 0; heard < kMostFramesHeard && can_.receive(frame); ++heard) {
    const auto verdict = commands_.take(frame, now);
    if (!verdict) continue;
    if (verdict->result == protocol::CommandResult::done) {
      pending_ = verdict;
      return verdict->command;
    }
    can_.send(commands_.reply(*verdict, verdict->result), deadline);
  }
  return std::nullopt;
}

void Broadcaster::reply(bool carried_out, Time deadline) {
  if (!pending_) return;
  commands_.carried_out(carried_out);
  const auto result = carried_out ? protocol::CommandResult::done : protocol::CommandResult::failed;
  can_.send(commands_.reply(*pending_, result), deadline);
  pending_.reset();
}

}  // namespace dottrack::cycle
