#include "app/core/tracking/ellipse_evidence.h"

#include <algorithm>

#include "app/core/estimation/dot_ellipse.h"
#include "app/core/tracking/expected_dot.h"

namespace dottrack::tracking {
namespace {

geometry::ImageEllipse ellipse_of(const core::DotView& view) {
  return {static_cast<double>(view.semi_major_px), static_cast<double>(view.semi_minor_px),
          static_cast<double>(view.angle_rad)};
}

double view_log_odds(const core::Camera& camera, const PlacedDot& dot, const core::DotView& view) {
  geometry::ImageEllipse expected;
  if (!faces(camera, dot) ||
      geometry::project_disc(camera.model, dot.place_m, dot.normal, 0.5 * dot.diameter_m,
                             expected) != geometry::OpticsStatus::ok) {
    return estimation::kLeastEllipseLogOdds;
  }
  return estimation::ellipse_log_odds(expected, ellipse_of(view));
}

double dot_log_odds(const core::Rig& rig, const PlacedDot& dot, const core::DotState& state) {
  double sum = 0.0;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    const core::DotView& view = state.views[camera];
    if (view.used) sum += view_log_odds(rig.cameras[camera], dot, view);
  }
  return std::min(sum, kMostDotLogOdds);
}

}  // namespace

double ellipse_log_odds_of(const core::Rig& rig, const core::Pose& pose,
                           const FollowResult& followed) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rig.target.dots.size(); ++i) {
    const PlacedDot dot = placed(rig.target.dots[i], pose);
    if (dot.has_normal()) sum += dot_log_odds(rig, dot, followed.dots[i]);
  }
  return sum;
}

}  // namespace dottrack::tracking
