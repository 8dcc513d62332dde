#pragma once
// From a pose message to CAN frames.

#include <cstdint>

#include "app/core/protocol/pose_message.h"

namespace dottrack::protocol {

// The group of frames, in the order to send them. base_id <= kLastBaseId. `counter` binds the
// group: count up by one a message; it is sent modulo 16. A message whose pose is not valid carries
// "not available" for position and orientation. A position outside +-838.8607 m, or a pose that is
// not finite or not a unit quaternion, goes out as not valid with out_of_range set.
PoseFrames encode(const PoseMessage& message, std::uint32_t base_id, std::uint64_t counter);

}  // namespace dottrack::protocol
