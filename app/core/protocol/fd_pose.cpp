#include "app/core/protocol/fd_pose.h"

#include <algorithm>

namespace dottrack::protocol {
namespace {

namespace s = layout::fd_pose;

// Rounded as for the classic messages, so the steps have to be theirs.
static_assert(s::kX.factor == layout::position::kX.factor && s::kX.length == 24);
static_assert(s::kQW.factor == layout::position2::kQW.factor && s::kQW.length == 16);
static_assert(s::kAge.factor == layout::quality::kAge.factor && s::kAge.length == 16);
static_assert(s::kResidual.factor == layout::position2::kResidual.factor);
static_assert(s::kFalseLock.length == layout::quality::kFalseLock.length);
static_assert(s::kSigmaYaw.factor == s::kSigmaX.factor);
static_assert(s::kSigmaYaw.start == s::kSigmaX.start + 5 * s::kSigmaX.length);
static_assert(s::kCorrPitchYaw.factor == s::kCorrXY.factor);
static_assert(s::kCorrPitchYaw.start == s::kCorrXY.start + 14 * s::kCorrXY.length);

void put_status(const PoseMessage& message, const RawPose& pose, LongPayload& payload) {
  put(s::kVersion, kProtocolVersion, payload);
  put(s::kState, static_cast<std::uint64_t>(message.state), payload);
  put(s::kPoseValid, pose.valid ? 1 : 0, payload);
  put(s::kOutOfRange, pose.out_of_range ? 1 : 0, payload);
  put(s::kReason, static_cast<std::uint64_t>(message.reason), payload);
  put(s::kCamerasUsed, message.cameras_used.bits(), payload);
  put(s::kDotsUsed, std::min<std::uint64_t>(message.dots_used, core::kMaxDots), payload);
  put(s::kPoseKind, static_cast<std::uint64_t>(message.kind), payload);
  put(s::kResetCount, message.reset_count, payload);
}

void put_quality(const RawPose& pose, LongPayload& payload) {
  put(s::kMidExposure, pose.mid_exposure, payload);
  put(s::kAge, pose.age, payload);
  put(s::kDegraded, pose.degraded, payload);
  put(s::kFalseLock, pose.false_lock, payload);
  put(s::kResidual, pose.residual, payload);
}

void put_pose(const RawPose& pose, LongPayload& payload) {
  put(s::kX, pose.position[0], payload);
  put(s::kY, pose.position[1], payload);
  put(s::kZ, pose.position[2], payload);
  put(s::kQW, pose.quaternion_wxyz[0], payload);
  put(s::kQX, pose.quaternion_wxyz[1], payload);
  put(s::kQY, pose.quaternion_wxyz[2], payload);
  put(s::kQZ, pose.quaternion_wxyz[3], payload);
}

template <class Raws>
void put_row(const Field& first, const Raws& raws, LongPayload& payload) {
  Field field{first.start, first.length};
  for (const std::uint64_t raw : raws) {
    put(field, raw, payload);
    field.start += field.length;
  }
}

}  // namespace

LongPayload fd_pose_payload(const PoseMessage& message, const RawPose& pose,
                            const GroupParts& parts, std::uint64_t dots) {
  LongPayload payload{};
  put_status(message, pose, payload);
  put(s::kCovarianceFollows, pose.covariance.available ? 1 : 0, payload);
  put(s::kMotionFollows, parts.motion ? 1 : 0, payload);
  put(s::kCamerasFollow, parts.cameras ? 1 : 0, payload);
  put(s::kDotsFollow, dots, payload);
  put_quality(pose, payload);
  put_pose(pose, payload);
  put_row(s::kSigmaX, pose.covariance.sigmas, payload);
  put_row(s::kCorrXY, pose.covariance.correlations, payload);
  return payload;
}

}  // namespace dottrack::protocol
