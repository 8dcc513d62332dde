#pragma once
// Locate: from the dots' 3-D positions to the vehicle's pose (paper sections 3.1.5, 3.2.4).

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::estimation {

struct LocatedDot {
  std::size_t dot = 0;                                      // index in the target
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();     // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of that position
};

enum class LocateStatus : std::uint8_t {
  ok,
  too_few_dots,  // fewer than three
  degenerate,    // the dots given lie on a line
  upside_down,   // the target is upright and this pose is not
  residual,      // RMS residual above the limit
};

// The pose that carries the target's dots onto the located ones: by the quaternion method, then
// with each dot weighed by its covariance. Its RMS residual, and its covariance as the dots' imply
// it, scaled up when the residuals are larger than those say. The output is written when the status
// is ok or residual.
LocateStatus locate(const core::Target& target, std::span<const LocatedDot> dots,
                    double max_rms_residual_m, core::Pose& pose);

// Why there is no pose; none when there is one.
core::Reason reason_of(LocateStatus status);

}  // namespace dottrack::estimation
