#pragma once
// The loop's voice and ear on the CAN bus.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/core/exposure/camera_light.h"
#include "app/core/protocol/broadcast_settings.h"
#include "app/core/protocol/command.h"
#include "app/core/protocol/pose_encoder.h"
#include "app/cycle/broadcast_plan.h"
#include "app/telemetry/cycle_record.h"
#include "hal/can_bus.h"

namespace dottrack::cycle {

// Sends with deadlines, allocates nothing. What does not go out is counted, and the sequence moves
// on: the receivers see the gap.
class Broadcaster {
 public:
  Broadcaster(hal::CanBus& can, const protocol::BroadcastSettings& settings)
      : can_(can),
        settings_(settings),
        plan_(settings.rates),
        commands_(settings.addressing, settings.targets),
        sequence_(settings.first_sequence) {}

  // Once a tick; sends what is due, the standing degraded reasons added. False: nothing was due.
  bool tell(protocol::PoseMessage message, Time deadline, telemetry::CycleCounters& counters);

  // After a group that was due: how the next camera stands with the light, if that is due, too. One
  // that does not go out is owed.
  void tell_light(std::span<const exposure::CameraLight> cameras, Time deadline,
                  telemetry::CycleCounters& counters);

  // A group out of turn, the last one: nothing but the state.
  void part(const protocol::PoseMessage& message, Time deadline,
            telemetry::CycleCounters& counters);

  // A reason that holds from now on.
  void degrade(protocol::Degraded reason) { settings_.standing.insert(reason); }

  // The identity goes out with the next group.
  void identify() { identity_wanted_ = true; }
  void identify_as(const protocol::IdentityMessage& identity);

  // The next command that is to be carried out; others are answered here. Looks at no more than a
  // bounded number of frames.
  std::optional<protocol::Command> listen(Time now, Time deadline);
  // What became of it.
  void reply(bool carried_out, Time deadline);

  const protocol::CommandCounts& command_counts() const { return commands_.counts(); }
  std::uint8_t next_sequence() const { return sequence_; }

 private:
  bool send(const hal::CanFrame& frame, Time deadline, telemetry::CycleCounters& counters);
  bool send_group(const protocol::PoseMessage& message, const protocol::GroupParts& parts,
                  Time deadline, telemetry::CycleCounters& counters);
  void send_identity(Time deadline, telemetry::CycleCounters& counters);

  hal::CanBus& can_;
  protocol::BroadcastSettings settings_;
  BroadcastPlan plan_;
  protocol::CommandReader commands_;
  std::uint8_t sequence_;  // of the next group
  bool identity_wanted_ = true;
  std::size_t lit_camera_ = 0;  // whose light is told next
  std::uint8_t lights_ = 0;     // told so far, modulo 256
  std::optional<protocol::CommandReader::Verdict> pending_;
  protocol::GroupFrames frames_;
};

}  // namespace dottrack::cycle
