#pragma once
// What a pose message comes to in raw numbers: what is valid, what fits, and how it is rounded.

#include <array>
#include <cstdint>

#include "app/core/protocol/covariance_rounding.h"
#include "app/core/protocol/pose_message.h"

namespace dottrack::protocol {

// Two's complement, as long as the signals; upper bits mean nothing.
struct RawPose {
  bool valid = false;
  bool out_of_range = false;  // there is a pose, but it does not fit
  std::uint64_t mid_exposure = 0;
  std::uint64_t age = 0;
  std::uint64_t degraded = 0;
  std::uint64_t false_lock = 0;
  std::uint64_t residual = 0;
  std::array<std::uint64_t, 3> position{};
  std::array<std::uint64_t, 4> quaternion_wxyz{};
  RoundedCovariance covariance;
};

struct RawMotion {
  std::array<std::uint64_t, 3> velocity{};
  std::array<std::uint64_t, 3> rates{};
};

struct RawDot {
  std::array<std::uint64_t, 3> position{};
  std::uint64_t sigma = 0;
};

RawPose raw_pose(const PoseMessage& message, const CovarianceSignals& covariance);
// `valid`: of the pose. Without one its motion is not available either.
RawMotion raw_motion(const PoseMessage& message, bool valid);
RawDot raw_dot(const DotReport& dot);
std::uint64_t raw_group_period(Duration period);

}  // namespace dottrack::protocol
