#pragma once
// From the dots as the cameras show them to the pose (paper sections 3.2.3, 3.2.4).

#include <array>

#include "app/core/estimation/dot_position.h"
#include "app/core/estimation/pose_fit.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/core/tracking/expected_dot.h"
#include "app/core/tracking/seen_dots.h"
#include "app/core/tracking/shared_light.h"

namespace dottrack::tracking {

// Triangulates each dot that two or more cameras show; starts from three or more of these (the
// quaternion method), else from the expected pose; fits the pose to every view of every dot.
class PoseLocator {
 public:
  explicit PoseLocator(const core::Rig& rig) : rig_(&rig), fitter_(rig) {}  // outlives the object

  // none: there is a pose. `placed`: the dots as expected, at the expectation's instant.
  core::Reason locate(const SeenDots& seen, const Expectation& expected, const PlacedDots& placed,
                      const estimation::CaptureTimes& times);

  // Of the last call. The pose means something when the reason was none, residual or
  // step_too_large; the covariance when none.
  bool has_pose() const { return has_pose_; }
  const estimation::PoseFit& fit() const { return fit_; }
  const std::array<core::DotState, core::kMaxDots>& dots() const { return dots_; }
  int dots_used() const;
  int views_used() const { return fit_.coordinates / 2; }
  int views() const { return static_cast<int>(observations_.size()); }
  int views_left_out() const { return views() - views_used(); }

 private:
  void triangulate(const SeenDots& seen, const Expectation& expected, const PlacedDots& placed,
                   const estimation::CaptureTimes& times);
  void locate_dot(std::size_t dot);
  void observe(const SeenDots& seen);
  void leave_out_wrong_views();
  bool dots_step_too_far(const PlacedDots& placed) const;
  bool pose_steps_too_far(const PlacedDots& placed) const;
  geometry::RigidMotion start(const Expectation& expected) const;
  double triangulated_residual_m() const;
  core::Reason judge(const PlacedDots& placed) const;
  void record(const SeenDots& seen);
  Eigen::Vector3d place_of(std::size_t dot) const;

  const core::Rig* rig_;
  estimation::PoseFitter fitter_;
  std::array<estimation::Views, core::kMaxDots> views_;
  estimation::DotObservations observations_;
  estimation::PoseFit fit_;
  std::array<core::DotState, core::kMaxDots> dots_{};
  bool has_pose_ = false;
};

}  // namespace dottrack::tracking
