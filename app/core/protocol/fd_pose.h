#pragma once
// The whole pose in the 64 bytes of one CAN FD frame.

#include "app/core/protocol/can_payload.h"
#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/pose_encoder.h"
#include "app/core/protocol/raw_pose.h"

namespace dottrack::protocol {

inline constexpr CovarianceSignals kFdCovariance{layout::fd_pose::kSigmaX,
                                                 layout::fd_pose::kCorrXY};

// All but CRC and Sequence. `pose` has its covariance rounded for kFdCovariance.
LongPayload fd_pose_payload(const PoseMessage& message, const RawPose& pose,
                            const GroupParts& parts, std::uint64_t dots);

}  // namespace dottrack::protocol
