#pragma once
// Locate: from the dots' 3-D positions to the vehicle's pose (paper sections 3.1.5, 3.2.4).

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "app/core/geometry/triangulation.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::estimation {

// What one dot says about the pose.
struct LocatedDot {
  std::size_t dot = 0;                                    // index in the target
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();   // world
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // 1 / m^2: inverse of its covariance
};

// A dot triangulated from two or more views.
LocatedDot triangulated_dot(std::size_t dot, const Eigen::Vector3d& position_m,
                            const Eigen::Matrix3d& covariance_m2);
enum class LocateStatus : std::uint8_t {
  ok,
  too_few_dots,  // fewer than three
  degenerate,    // the dots given do not determine the pose to within the residual limit
  upside_down,   // the target is upright and this pose is not
  residual,      // RMS residual above the limit
};

// The pose that carries the target's dots onto the located ones: the quaternion method, then
// Gauss-Newton steps that weigh each dot by its information. Gives the RMS residual over all dots
// and the covariance as the dots' information implies it, scaled up where the residuals are larger
// than that says. The output is meant to be used only when the status is ok; its residual also when
// it is residual.
LocateStatus locate(const core::Target& target, std::span<const LocatedDot> dots,
                    double max_rms_residual_m, core::Pose& pose);

// Why there is no pose; none when there is one.
core::Reason reason_of(LocateStatus status);

}  // namespace dottrack::estimation
