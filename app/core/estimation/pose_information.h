#pragma once
// What one camera's views say about the pose, and what a motion state learns from it.

#include "app/core/estimation/motion_state.h"
#include "hal/base/time.h"

namespace dottrack::estimation {

// Normal equations of the small step (translation in m, world axes; rotation in rad about world
// axes through the vehicle's origin) from a pose that the views were linearised at.
struct PoseInformation {
  Time captured{};
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Matrix6d information = Matrix6d::Zero();  // J' R^-1 J; may be singular
  Vector6d gradient = Vector6d::Zero();     // J' R^-1 (z - h(pose))
  int coordinates = 0;                      // rows of J
};

// The gradient of the same views at the state's pose.
Vector6d gradient_at(const MotionState& state, const PoseInformation& views);

// `sum` now says what both say; both of one capture time.
void add(const PoseInformation& views, PoseInformation& sum);

// The update of an (error-state) Kalman filter in information form: the state takes in what the
// views say of its pose. Returns the logarithm of how probable the state made the views, up to a
// term that is the same for all states. The covariance must be positive definite; it stays so.
double take_in(const PoseInformation& views, MotionState& state);

// How far the views contradict a pose known to `covariance`: the squared innovation in its own
// standard deviations, over the directions that the views see. `gradient` is that of the views at
// the pose. Of right views chi-square distributed with at most min(6, coordinates) degrees of
// freedom.
double surprise(const Matrix6d& information, const Vector6d& gradient, const Matrix6d& covariance);

// What right views exceed once in a million times.
double largest_surprise(int coordinates);

}  // namespace dottrack::estimation
