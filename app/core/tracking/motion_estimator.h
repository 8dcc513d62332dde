#pragma once
// The filter in the tracker's service: where the target is expected, how it moves, and for how long
// its way may be followed without seeing it.

#include <span>

#include "app/core/camera_frame.h"
#include "app/core/estimation/lasting_share.h"
#include "app/core/estimation/pose_filter.h"
#include "app/core/estimation/pose_fit.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/core/tracking/expected_dot.h"

namespace dottrack::tracking {

class MotionEstimator {
 public:
  // The rig must outlive the object.
  explicit MotionEstimator(const core::Rig& rig) : rig_(&rig), filter_(rig.vehicle) {}

  // A new lock.
  void start(const estimation::PoseFit& found, Time at);
  void stop() { filter_.stop(); }
  bool running() const { return filter_.running(); }

  // The same lock goes on: what each camera says of the pose found. False: the vehicle cannot have
  // come so far since the last views; nothing was taken in. Where no time has passed since then
  // (the same pictures again), the filter starts anew.
  bool take_in(std::span<const core::CameraFrame> frames, const estimation::PoseFit& found,
               Time at);

  // The vehicle may have come to this pose since the last views, as far as both are known; true
  // where the filter cannot say.
  bool is_reachable(const core::Pose& pose, Time at) const;

  // The views of the last pose are not older than the rig's coasting time.
  bool may_coast(Time now) const;

  // Where the target is expected; from the last pose alone where the filter cannot say.
  Expectation expect(Time at, const core::Pose& last_pose) const;

  // Nothing is known where the filter does not run.
  core::FilteredPose filtered(Time at) const;

 private:
  const core::Rig* rig_;
  estimation::PoseFilter filter_;
  estimation::LastingShare lasting_;
  // Of the pose's covariance: what no mean over ticks takes away.
  estimation::Matrix6d systematic_ = estimation::Matrix6d::Zero();
  Time found_{};   // the instant of the last pose
  int poses_ = 0;  // since the start
};

}  // namespace dottrack::tracking
