#include "app/core/tracking/pose_locator.h"

#include <algorithm>
#include <cmath>

#include "app/core/estimation/dot_position.h"
#include "app/core/geometry/orientation.h"

namespace dottrack::tracking {
namespace {

using core::Reason;
using Eigen::Vector3d;
using estimation::PoseFitStatus;

constexpr int kFewWrong = 4;  // of so many views one may be wrong

// Root of the largest position variance that the pose's covariance gives any dot of the target.
double worst_dot_sigma_m(const core::Target& target, const core::Pose& pose) {
  double worst = 0.0;
  for (const core::TargetDot& dot : target.dots) {
    const Vector3d lever = pose.orientation * dot.position_m;
    Eigen::Matrix<double, 3, 6> j;
    j.leftCols<3>().setIdentity();
    j.rightCols<3>() << 0.0, lever.z(), -lever.y(), -lever.z(), 0.0, lever.x(), lever.y(),
        -lever.x(), 0.0;
    worst = std::max(worst, (j * pose.covariance * j.transpose()).trace());
  }
  return std::sqrt(worst);
}

core::DotView view_of(const SeenDot& seen) {
  const image::Region& region = seen.region;
  core::DotView view;
  view.seen = true;
  view.flaw = seen.flaw;
  view.bloomed = seen.bloomed;
  view.pixel = region.centroid_px.cast<float>();
  view.semi_major_px = static_cast<float>(region.semi_major_px);
  view.semi_minor_px = static_cast<float>(region.semi_minor_px);
  view.angle_rad = static_cast<float>(region.angle_rad);
  return view;
}

}  // namespace

Vector3d PoseLocator::place_of(std::size_t dot) const {
  return fit_.pose.orientation * rig_->target.dots[dot].position_m + fit_.pose.position_m;
}

Reason PoseLocator::locate(const SeenDots& seen, const Expectation& expected,
                           const PlacedDots& placed, const estimation::CaptureTimes& times) {
  has_pose_ = false;
  fit_ = {};
  triangulate(seen, expected, placed, times);
  observe(seen);
  if (dots_step_too_far(placed)) return Reason::step_too_large;
  const PoseFitStatus status =
      fitter_.fit(as_span(observations_), times, start(expected), expected.dot_spread, fit_);
  if (dots_used() < static_cast<int>(core::kMinDots)) return Reason::too_few_dots;
  if (status != PoseFitStatus::ok) return Reason::degenerate_geometry;
  has_pose_ = true;
  if (kFewWrong * views_left_out() <= views()) leave_out_wrong_views();
  record(seen);
  fit_.pose.rms_residual_m = triangulated_residual_m();
  return judge(placed);
}

void PoseLocator::triangulate(const SeenDots& seen, const Expectation& expected,
                              const PlacedDots& placed, const estimation::CaptureTimes& times) {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    views_[dot].clear();
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      if (!seen.counts(camera, dot)) continue;
      views_[dot].push_back({camera, &rig_->cameras[camera], &seen.by_camera[camera][dot].sighting,
                             way_of(expected, placed[dot], times.after_s[camera])});
    }
    locate_dot(dot);
  }
}

void PoseLocator::locate_dot(std::size_t dot) {
  core::DotState& state = dots_[dot];
  state = {};
  estimation::DotPosition position;
  if (!estimation::locate_dot(views_[dot], position)) return;
  state.located = true;
  state.position_m = position.position_m;
  state.position_sigma_m = std::sqrt(position.covariance_m2.trace());
  state.diameter_m = position.diameter_m;
}

// A view that all the others contradict may be half of what a dot was located from.
void PoseLocator::leave_out_wrong_views() {
  std::array<bool, core::kMaxDots> anew{};
  for (std::size_t i = 0; i < fit_.views.size(); ++i) {
    if (fit_.views[i].used) continue;
    const estimation::DotObservation& wrong = observations_[i];
    estimation::Views& views = views_[wrong.dot];
    views.erase(std::remove_if(views.begin(), views.end(),
                               [&](const auto& view) { return view.camera == wrong.camera; }),
                views.end());
    anew[wrong.dot] = true;
  }
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if (anew[dot]) locate_dot(dot);
  }
}

void PoseLocator::observe(const SeenDots& seen) {
  observations_.clear();
  for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
    for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
      if (!seen.counts(camera, dot)) continue;
      const SeenDot& view = seen.by_camera[camera][dot];
      observations_.push_back({static_cast<std::uint8_t>(camera), static_cast<std::uint8_t>(dot),
                               view.region.centroid_px, view.covariance_px2});
    }
  }
}

bool PoseLocator::dots_step_too_far(const PlacedDots& placed) const {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if (dots_[dot].located &&
        (dots_[dot].position_m - placed[dot].place_m).norm() > rig_->target.max_step_m) {
      return true;
    }
  }
  return false;
}

bool PoseLocator::pose_steps_too_far(const PlacedDots& placed) const {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if ((place_of(dot) - placed[dot].place_m).norm() > rig_->target.max_step_m) return true;
  }
  return false;
}

geometry::RigidMotion PoseLocator::start(const Expectation& expected) const {
  StaticVector<Vector3d, core::kMaxDots> body;
  StaticVector<Vector3d, core::kMaxDots> world;
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if (!dots_[dot].located) continue;
    body.push_back(rig_->target.dots[dot].position_m);
    world.push_back(dots_[dot].position_m);
  }
  geometry::RigidMotion motion;
  if (geometry::absolute_orientation(as_span(body), as_span(world), motion) ==
      geometry::OrientationStatus::ok) {
    return motion;
  }
  return {expected.pose.position_m, expected.pose.orientation};
}

int PoseLocator::dots_used() const {
  std::array<bool, core::kMaxDots> used{};
  for (std::size_t i = 0; i < fit_.views.size(); ++i) {
    if (fit_.views[i].used) used[observations_[i].dot] = true;
  }
  return static_cast<int>(std::count(used.begin(), used.end(), true));
}

double PoseLocator::triangulated_residual_m() const {
  double sum = 0.0;
  int n = 0;
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if (!dots_[dot].located) continue;
    sum += (dots_[dot].position_m - place_of(dot)).squaredNorm();
    ++n;
  }
  return n == 0 ? 0.0 : std::sqrt(sum / n);
}

Reason PoseLocator::judge(const PlacedDots& placed) const {
  const core::Pose& pose = fit_.pose;
  const double limit_m = rig_->limits.max_rms_residual_m;
  if (!(pose.rms_residual_m <= limit_m)) return Reason::residual;
  if (!(worst_dot_sigma_m(rig_->target, pose) <= limit_m)) return Reason::degenerate_geometry;
  const bool upright = (pose.orientation * Vector3d::UnitZ()).z() > 0.0;
  if (rig_->target.upright && !upright) return Reason::upside_down;
  return pose_steps_too_far(placed) ? Reason::step_too_large : Reason::none;
}

void PoseLocator::record(const SeenDots& seen) {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      const SeenDot& view = seen.by_camera[camera][dot];
      if (!view.any) continue;
      dots_[dot].views[camera] = view_of(view);
      dots_[dot].views[camera].residual_px =
          static_cast<float>((view.sighting.pixel - view.sighting.pixel_of(place_of(dot))).norm());
    }
  }
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const estimation::FittedView& fitted = fit_.views[i];
    core::DotState& state = dots_[observations_[i].dot];
    core::DotView& view = state.views[observations_[i].camera];
    view.used = fitted.used;
    view.residual_px = static_cast<float>(fitted.residual_px);
    view.normalised_residual = static_cast<float>(fitted.normalised);
    if (fitted.used) state.cameras.insert(observations_[i].camera);
  }
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    if (!dots_[dot].located && !dots_[dot].cameras.empty()) dots_[dot].position_m = place_of(dot);
  }
}

}  // namespace dottrack::tracking
