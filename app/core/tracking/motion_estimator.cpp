#include "app/core/tracking/motion_estimator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "app/core/estimation/rotation.h"
#include "hal/base/static_vector.h"

namespace dottrack::tracking {
namespace {

using estimation::MotionState;

constexpr double kSpreadSigmas = 3.0;

estimation::Twist twist_of(const MotionState& state) {
  return {state.velocity_m_s, state.orientation * state.rates_rad_s};
}

core::Pose pose_of(const MotionState& state) {
  core::Pose pose;
  pose.position_m = state.position_m;
  pose.orientation = state.orientation;
  pose.covariance = state.covariance.topLeftCorner<6, 6>();
  return pose;
}

// The pose found, as it was when a camera exposed.
geometry::RigidMotion carried(const core::Pose& found, const estimation::Twist& motion,
                              double after_s) {
  estimation::Vector6d step;
  step << after_s * motion.velocity_m_s, after_s * motion.turn_rad_s;
  return estimation::stepped({found.position_m, found.orientation}, step);
}

double reach_m(const core::Target& target) {
  double reach = 0.0;
  for (const core::TargetDot& dot : target.dots) reach = std::max(reach, dot.position_m.norm());
  return reach;
}

}  // namespace

void MotionEstimator::start(const estimation::PoseFit& found, Time at) {
  core::Pose random = found.pose;
  random.covariance -= found.systematic;
  filter_.start(random, at);
  systematic_ = found.systematic;
  found_ = at;
  poses_ = 1;
}

bool MotionEstimator::take_in(std::span<const core::CameraFrame> frames,
                              const estimation::PoseFit& found, Time at) {
  lasting_.take_in(as_span(found.residuals));
  if (!running() || at <= found_) {
    start(found, at);
    return true;
  }
  const double lasting = lasting_.value();
  const estimation::Twist motion = twist_of(filter_.at(at));
  StaticVector<estimation::PoseInformation, kMaxCameras> cameras;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    estimation::CameraEvidence camera = found.cameras[i];
    if (camera.coordinates == 0) continue;
    camera.normal.scale(1.0 / (1.0 - lasting));
    const geometry::RigidMotion pose =
        carried(found.pose, motion, to_seconds(frames[i].mid_exposure - at));
    cameras.push_back({.captured = frames[i].mid_exposure,
                       .position_m = pose.translation_m,
                       .orientation = pose.rotation,
                       .information = camera.normal.information,
                       .gradient = camera.normal.gradient,
                       .coordinates = camera.coordinates});
  }
  if (filter_.update(as_span(cameras)).jumped) return false;
  systematic_ = found.systematic + lasting * (found.pose.covariance - found.systematic);
  found_ = at;
  ++poses_;
  return true;
}

bool MotionEstimator::is_reachable(const core::Pose& pose, Time at) const {
  if (!running() || at <= found_) return true;
  const MotionState state = filter_.at(at);
  estimation::Vector6d off;
  off << pose.position_m - state.position_m,
      estimation::rotation_vector(pose.orientation * state.orientation.conjugate());
  const estimation::Matrix6d variance =
      state.covariance.topLeftCorner<6, 6>() + systematic_ + pose.covariance;
  return off.dot(variance.ldlt().solve(off)) <= estimation::largest_surprise(6);
}

bool MotionEstimator::may_coast(Time now) const {
  return running() && now > found_ && now - found_ <= rig_->limits.coast;
}

Expectation MotionEstimator::expect(Time at, const core::Pose& last_pose) const {
  if (!running() || at <= found_) return last_pose;
  const MotionState state = filter_.at(at);
  Expectation expected(pose_of(state));
  expected.motion = twist_of(state);
  expected.at = at;
  expected.moving = true;
  const double shift_m = std::sqrt(state.covariance.diagonal().head<3>().sum());
  const double turn_rad = std::sqrt(state.covariance.diagonal().segment<3>(3).sum());
  expected.spread_m = kSpreadSigmas * (shift_m + turn_rad * reach_m(rig_->target));
  return expected;
}

core::FilteredPose MotionEstimator::filtered(Time at) const {
  core::FilteredPose result;
  if (!running()) return result;
  const MotionState state = filter_.at(at);
  result.known = true;
  result.pose = pose_of(state);
  result.pose.covariance += systematic_;
  if (poses_ < 2) return result;
  result.motion = estimation::motion_of(state);
  result.motion_covariance = state.covariance.bottomRightCorner<6, 6>();
  return result;
}

}  // namespace dottrack::tracking
