#pragma once
// The filter over time (paper section 3.3, "without undue lag"): where the vehicle is and how it
// moves, from each camera's views at their own capture time.

#include <array>
#include <span>

#include "app/core/estimation/motion_mixture.h"
#include "app/core/estimation/motion_state.h"
#include "app/core/estimation/pose_information.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/camera_set.h"

namespace dottrack::estimation {

struct UpdateResult {
  CameraSet accepted;   // indices of the cameras given: their innovation passed the gate
  bool jumped = false;  // most cameras agree on a place out of reach: nothing was taken in
  std::array<double, kMaxCameras> surprise{};  // of each camera: see surprise()
};

// An error-state Kalman filter for each of five ways of moving, weighed by what the cameras see: at
// rest it averages for long, at a change of speed it follows at once. It allocates nothing and its
// work is bounded; the same calls give the same states, bit for bit.
class PoseFilter {
 public:
  explicit PoseFilter(const core::MotionLimits& limits) : limits_(limits) {}

  // A new lock: the pose as the images gave it, its speed anywhere within the vehicle's limits.
  void start(const core::Pose& pose, Time captured);
  void stop() { running_ = false; }
  bool running() const { return running_; }

  // The cameras of one tick, at most 16, in any order; each is taken at its own capture time. Views
  // older than the last ones taken in are carried on to those. Running only.
  UpdateResult update(std::span<const PoseInformation> cameras);

  // The state at a time after the last views, its covariance grown by all that the vehicle may have
  // done since: to coast, or to predict the moment of sending. Before the last views the motion is
  // followed backwards: meant for a tick or less. Running only.
  MotionState at(Time time) const;
  // The state at the last views' capture.
  const MotionState& last() const { return last_; }
  double probability(MotionModel model) const { return mixture_.probability(model); }

 private:
  core::MotionLimits limits_;
  bool running_ = false;
  MotionMixture mixture_;
  MotionState last_;  // the mixture's mean
};

// What the state says of the vehicle's motion.
core::Motion motion_of(const MotionState& state);

}  // namespace dottrack::estimation
