#include "app/core/protocol/pose_encoder.h"

#include <cmath>

#include "app/core/protocol/pose_layout.h"

namespace dottrack::protocol {
namespace {

using namespace layout;

constexpr double kLargestPosition_m = static_cast<double>(kX.signed_max()) / kPositionStepsPerMetre;

constexpr double kUnitTolerance = 1e-6;  // far below half a step of the quaternion

// Written so that NaN fails every comparison.
bool fits(const PoseMessage& message) {
  return message.position_m.allFinite() &&
         message.position_m.cwiseAbs().maxCoeff() <= kLargestPosition_m &&
         std::abs(message.orientation.squaredNorm() - 1.0) < kUnitTolerance;
}

std::uint64_t put_scaled(Field field, double value, double steps, bool available) {
  return put_signed(field, available ? std::llround(value * steps) : field.not_available());
}

std::uint64_t status_word(const PoseMessage& message, bool pose_fits) {
  const bool valid = message.pose_valid && pose_fits;
  return put(kVersion, kProtocolVersion) | put(kState, static_cast<std::uint64_t>(message.state)) |
         put(kPoseValid, valid ? 1 : 0) |
         put(kOutOfRange, message.pose_valid && !pose_fits ? 1 : 0) |
         put(kReason, static_cast<std::uint64_t>(message.reason)) |
         put(kCamerasUsed, message.cameras_used.bits()) | put(kDotsUsed, message.dots_used) |
         put(kResetCount, message.reset_count);
}

std::uint64_t time_word(Time mid_exposure) {
  const auto us = std::chrono::floor<std::chrono::microseconds>(mid_exposure.time_since_epoch());
  return put_signed(kMidExposureUs, us.count());
}

}  // namespace

PoseFrames encode(const PoseMessage& message, std::uint32_t base_id, std::uint64_t counter) {
  const bool pose_fits = fits(message);
  const bool available = message.pose_valid && pose_fits;
  const auto metres = [available](Field field, double value) {
    return put_scaled(field, value, kPositionStepsPerMetre, available);
  };
  const auto part = [available](Field field, double value) {
    return put_scaled(field, value, kQuaternionSteps, available);
  };
  const Eigen::Vector3d& p = message.position_m;
  const Eigen::Quaterniond& q = message.orientation;

  std::array<std::uint64_t, kFramesPerPose> words{};
  words[kStatus] = status_word(message, pose_fits);
  words[kTime] = time_word(message.mid_exposure);
  words[kPose1] = metres(kX, p.x()) | metres(kY, p.y());
  words[kPose2] = metres(kZ, p.z()) | part(kQw, q.w());
  words[kPose3] = part(kQx, q.x()) | part(kQy, q.y()) | part(kQz, q.z());

  PoseFrames frames;
  for (std::uint32_t i = 0; i < kFramesPerPose; ++i) {
    frames[i] = {base_id + i, to_payload(words[i] | put(kCounter, counter))};
  }
  return frames;
}

}  // namespace dottrack::protocol
