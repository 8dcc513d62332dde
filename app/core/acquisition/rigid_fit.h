#pragma once
// How probably a rigid body's dots are found where they are, if it is the body: the residual's
// probability density (paper sections 3.1.5, 3.2.4 know only its root mean square).

#include <Eigen/Core>
#include <span>

namespace dottrack::acquisition {

// One dot of the body, in any frame that is the body's but for a rotation.
struct RigidDot {
  Eigen::Vector3d arm_m = Eigen::Vector3d::Zero();    // its ideal place, from any point of the body
  Eigen::Vector3d error_m = Eigen::Vector3d::Zero();  // found minus ideal, in any pose close by
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of the error
};

// Natural logarithm of the density of the dots' places, per m^(3 m), when every pose near this one
// is as probable, with one pose to a cubic metre and to a radian^3 of turns: the integral over the
// poses of the product of the dots' normal distributions. It does not depend on the pose that the
// errors are taken from. At least three dots that are not on a line.
//
// The covariances hold what changes from tick to tick. What does not, the errors of survey and
// calibration, is not known: it is taken to be of any size from a hundredth to half of
// max_rms_residual_m, each size about as probable as any other on a scale of logarithms.
double log_fit(std::span<const RigidDot> dots, double max_rms_residual_m);

// A small motion: a turn about a point, and a shift.
struct RigidStep {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();

  Eigen::Vector3d of(const Eigen::Vector3d& place_m) const {
    return shift_m + turn_rad.cross(place_m - middle_m);
  }
};

// The step from the pose that the errors are taken from to the one that fits these dots best.
// False when they do not determine one.
bool best_step(std::span<const RigidDot> dots, double max_rms_residual_m, RigidStep& step);

// log_fit for two dots, per m^6: they leave a turn about their line open.
double log_pair_fit(const RigidDot& a, const RigidDot& b, double max_rms_residual_m);

}  // namespace dottrack::acquisition
