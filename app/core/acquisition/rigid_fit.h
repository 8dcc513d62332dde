#pragma once
// How probably a rigid body's dots are found where they are, if it is the body: the residual's
// probability density (paper sections 3.1.5, 3.2.4 know only its root mean square).

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/limits.h"
#include "hal/base/static_vector.h"

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

// log_fit of a few dots, and of the same without one of them: each dot's part in it is found once.
class RigidFit {
 public:
  RigidFit(std::span<const RigidDot> dots, double max_rms_residual_m);

  double log_density() const { return log_density_of_all_but(dots_.size()); }
  double log_density_without(std::size_t dot) const { return log_density_of_all_but(dot); }
  // The step from the pose that the errors are taken from to the one that fits the other dots best.
  // False when they do not determine one.
  bool best_step_without(std::size_t dot, RigidStep& step) const;

 private:
  static constexpr std::size_t kSystematic = 5;  // errors of survey and calibration, each tried

  // Dots' normal distributions as one of the six coordinates of the pose, that their errors are
  // linear in. Of the information only the lower triangle.
  struct PoseNormal {
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
    double chi2 = 0.0;
    double log_det = 0.0;  // of the covariances; not finite where one is none

    PoseNormal() = default;
    PoseNormal(const RigidDot& dot, const Eigen::Vector3d& middle_m, double systematic_m);
    PoseNormal& operator+=(const PoseNormal& other);
  };

  static double log_density_of(const PoseNormal& normal, std::size_t dots);
  PoseNormal all_but(std::size_t dot, std::size_t systematic) const;
  double log_density_of_all_but(std::size_t dot) const;

  Eigen::Vector3d middle_m_;
  StaticVector<std::array<PoseNormal, kSystematic>, core::kMaxDots> dots_;
};

// log_fit for two dots, per m^6: they leave a turn about their line open.
double log_pair_fit(const RigidDot& a, const RigidDot& b, double max_rms_residual_m);

}  // namespace dottrack::acquisition
