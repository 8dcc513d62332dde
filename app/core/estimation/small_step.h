#pragma once
// The six coordinates in which a pose is wrong: a translation in metres along the world's axes,
// then a rotation in radians about the world's axes through the vehicle's origin.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "app/core/geometry/orientation.h"

namespace dottrack::estimation {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

inline geometry::RigidMotion stepped(const geometry::RigidMotion& motion, const Vector6d& step) {
  const Eigen::Vector3d turn = step.tail<3>();
  const double angle = turn.norm();
  geometry::RigidMotion next = motion;
  next.translation_m += step.head<3>();
  if (angle > 0.0) next.rotation = Eigen::AngleAxisd(angle, turn / angle) * motion.rotation;
  next.rotation.normalize();
  return next;
}

// A known motion in between: velocity in m/s, turn in rad/s about the same axes.
struct Twist {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();  // world axes
};

}  // namespace dottrack::estimation
