#pragma once
// Where the vehicle is and how it moves, with what is known of both.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "app/core/estimation/small_step.h"
#include "hal/base/time.h"

namespace dottrack::estimation {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

struct MotionState {
  Time at{};
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();             // T_world_vehicle
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world, unit
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  // of the vehicle's origin, world axes
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();   // vehicle axes, as a gyroscope has them
  // Of the small step from this state to the true one: translation (m) and rotation (rad) as in
  // core::Pose, then velocity (m/s, world axes) and rates (rad/s, vehicle axes).
  Matrix12d covariance = Matrix12d::Zero();
};

// The small step from b to a, in the covariance's order.
Vector12d difference(const MotionState& a, const MotionState& b);
// The state after a small step; its covariance stays as it is.
void move_by(const Vector12d& step, MotionState& state);

}  // namespace dottrack::estimation
