#include "tests/unit/estimation/motion_drive.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace dottrack::estimation {

Time time_at(double seconds) {
  return Time(std::chrono::round<Duration>(std::chrono::duration<double>(seconds)));
}

core::Pose pose_from(const PoseInformation& all) {
  MotionState state;
  state.position_m = all.position_m;
  state.orientation = all.orientation;
  core::Pose pose;
  pose.covariance = all.information.llt().solve(Matrix6d::Identity());
  Vector12d step = Vector12d::Zero();
  step.head<6>() = pose.covariance * all.gradient;
  move_by(step, state);
  pose.position_m = state.position_m;
  pose.orientation = state.orientation;
  return pose;
}

void Consistency::add(double normalised_squared_error) {
  constexpr double kEllipsoidOf95Percent = 12.5916;  // chi-square, 6 degrees of freedom
  ++samples_;
  sum_ += normalised_squared_error;
  inside_ += normalised_squared_error <= kEllipsoidOf95Percent ? 1 : 0;
}

double Consistency::band() const {
  return 1.96 * std::sqrt(12.0 / samples_);
}

}  // namespace dottrack::estimation
