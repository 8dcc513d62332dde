#include "app/core/estimation/motion.h"

#include <cmath>

namespace dottrack::estimation {
namespace {

// The axis times the angle, which is the shorter of the two that a quaternion stands for.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d part = sign * rotation.vec();
  const double sine = part.norm();
  const double half_angle = std::atan2(sine, sign * rotation.w());
  return sine > 0.0 ? Eigen::Vector3d(2.0 * half_angle / sine * part) : Eigen::Vector3d::Zero();
}

}  // namespace

core::Motion motion_between(const core::Pose& before, Time captured_before, const core::Pose& now,
                            Time captured_now) {
  core::Motion motion;
  const double seconds = to_seconds(captured_now - captured_before);
  if (!(seconds > 0.0)) return motion;
  motion.known = true;
  motion.velocity_m_s = (now.position_m - before.position_m) / seconds;
  motion.rates_rad_s = rotation_vector(before.orientation.conjugate() * now.orientation) / seconds;
  return motion;
}

}  // namespace dottrack::estimation
