#pragma once
// From what the tracker found and how the tick went to what the bus is told.

#include <cstddef>

#include "app/core/protocol/broadcast_settings.h"
#include "app/core/protocol/pose_message.h"
#include "app/telemetry/cycle_record.h"

namespace dottrack::cycle {

// What is sent of a tick.
struct SentPose {
  protocol::PoseKind kind = protocol::PoseKind::measured;
  bool valid = false;
  core::Pose pose;
  Time at{};  // when it holds
};

// `predicted`: the filter's pose as `now` comes; asked for only where that is the choice.
SentPose chosen_pose(const telemetry::CycleRecord& record, protocol::PoseChoice choice,
                     const core::FilteredPose& predicted, Time now);

struct RigSize {
  std::size_t cameras = 0;
  std::size_t dots = 0;
};

// How things stand as `now` comes, after the last message. `before`: the counters as that message
// went out.
protocol::PoseMessage pose_report(const telemetry::CycleRecord& record, const SentPose& sent,
                                  const RigSize& rig, const telemetry::CycleCounters& before,
                                  Time now);

}  // namespace dottrack::cycle
