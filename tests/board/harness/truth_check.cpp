#include "tests/board/harness/truth_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::board {

double angle_between_deg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b) * 180.0 / std::numbers::pi;
}

void TruthCheck::add(const PoseOf& pose, const PoseOf& truth) {
  const double position_m = (pose.position_m - truth.position_m).norm();
  const double attitude_deg = angle_between_deg(pose.orientation, truth.orientation);
  ++poses_;
  // Written so that what is not a number is wrong too.
  const bool right = position_m <= kWrongPosition_m && attitude_deg <= kWrongAttitude_deg;
  wrong_ += right ? 0 : 1;
  position_squares_ += position_m * position_m;
  attitude_squares_ += attitude_deg * attitude_deg;
  position_max_m_ = std::max(position_max_m_, position_m);
  attitude_max_deg_ = std::max(attitude_max_deg_, attitude_deg);
}

double TruthCheck::position_rms_m() const {
  return poses_ == 0 ? 0.0 : std::sqrt(position_squares_ / static_cast<double>(poses_));
}

double TruthCheck::attitude_rms_deg() const {
  return poses_ == 0 ? 0.0 : std::sqrt(attitude_squares_ / static_cast<double>(poses_));
}

}  // namespace dottrack::board
