#pragma once
// From messages to CAN frames, by the layout of dottrack.dbc.

#include <cstddef>
#include <cstdint>

#include "app/core/protocol/addressing.h"
#include "app/core/protocol/pose_message.h"
#include "hal/base/can_frame.h"
#include "hal/base/static_vector.h"

namespace dottrack::protocol {

// Which messages a group has beside Status to Orientation (classic) or FdPose (FD).
struct GroupParts {
  bool covariance = false;  // in FD part of FdPose in any case
  bool motion = false;
  bool cameras = false;
  bool dots = false;  // as many as the message knows
};

inline constexpr std::size_t kMaxGroupFrames = 6 + 5 + 2 + 1 + 2 * core::kMaxDots;
using GroupFrames = StaticVector<hal::CanFrame, kMaxGroupFrames>;

// Replaces `frames` by the group, in the order to send it. `sequence` binds the group: one more
// with each, modulo 256. No allocation.
//
// Without a valid pose, position, orientation and all that describes them is "not available". A
// position outside +-838.8607 m, or a pose that is not finite or whose quaternion is not a unit
// one, goes out as not valid with OutOfRange set. A covariance that does not fit, or is not one,
// goes out as not available with covariance_unknown among the degraded reasons. What describes a
// quality is rounded to the worse side: age, residual, sigmas and false-lock probability never
// understate, and the covariance as sent minus the true one is positive semidefinite.
void encode_group(const PoseMessage& message, const GroupParts& parts, const Addressing& addressing,
                  std::uint8_t sequence, GroupFrames& frames);

// Version and Configuration, in this order.
using IdentityFrames = std::array<hal::CanFrame, 2>;
IdentityFrames encode_identity(const IdentityMessage& message, const Addressing& addressing,
                               std::uint8_t sequence);

}  // namespace dottrack::protocol
