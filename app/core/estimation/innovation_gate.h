#pragma once
// Which cameras' views a filter may take in: one that contradicts all others is left out, and a
// place that the vehicle cannot have reached is a jump.

#include <array>
#include <span>

#include "app/core/estimation/motion_state.h"
#include "app/core/estimation/pose_information.h"
#include "app/core/rig.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {

// One camera's views beside the pose that was expected at their time.
struct ExpectedViews {
  PoseInformation views;
  Vector6d gradient = Vector6d::Zero();  // of the views, at the expected pose
  Matrix6d expected = Matrix6d::Zero();  // covariance of the expected pose
};
using ExpectedCameras = StaticVector<ExpectedViews, kMaxCameras>;

// What is expected of the vehicle besides its covariance.
struct Reach {
  Vector6d from_last = Vector6d::Zero();  // the expected pose's step from the last one known
  Matrix6d last = Matrix6d::Zero();       // the covariance of the last one
  double seconds = 0.0;                   // since then
};

struct Judgement {
  CameraSet accepted;  // indices of the cameras given
  // At least two cameras, and most of them, agree on a place that is out of the vehicle's reach.
  bool jumped = false;
  std::array<double, kMaxCameras> surprise{};  // of each, against what was expected
};

// Cameras that contradict what was expected are outvoted, if more do not, or if they do not agree
// with one another; they win if more of them agree on a place within the vehicle's limits. A camera
// whose figures are not finite is left out. Bounded: at most n^2 / 2 small solutions.
Judgement judge(const ExpectedCameras& cameras, const Reach& reach,
                const core::MotionLimits& limits);

}  // namespace dottrack::estimation
