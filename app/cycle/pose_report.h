#pragma once
// From what the tracker found and how the tick went to what the bus is told.

#include <cstddef>

#include "app/core/protocol/pose_message.h"
#include "app/telemetry/cycle_record.h"

namespace dottrack::cycle {

struct RigSize {
  std::size_t cameras = 0;
  std::size_t dots = 0;
};

// How things stand as `now` comes, after the last message. `before`: the counters as that message
// went out.
protocol::PoseMessage pose_report(const telemetry::CycleRecord& record, const RigSize& rig,
                                  const telemetry::CycleCounters& before, Time now);

}  // namespace dottrack::cycle
