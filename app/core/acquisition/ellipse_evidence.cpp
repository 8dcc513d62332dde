#include "app/core/acquisition/ellipse_evidence.h"

#include <algorithm>

#include "app/core/estimation/dot_ellipse.h"
#include "app/core/geometry/projected_circle.h"

namespace dottrack::acquisition {
namespace {

// What the views of one dot may say together. They are not independent: a flat disc that lies by
// chance as the dot would looks right in all of them.
constexpr double kMostForDot = 1.0;
constexpr double kMostAgainstDot = -8.0;

// Of a view from behind, where no dot shows.
constexpr double kFromBehind = -4.0;

double log_odds_of_view(const CameraView& view, const estimation::Sighting& sighting,
                        const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                        double radius_m) {
  if (geometry::facing(view.camera->model, centre_m, normal) <= 0.0) return kFromBehind;
  geometry::ImageEllipse expected;
  if (geometry::project_disc(view.camera->model, centre_m, normal, radius_m, expected) !=
      geometry::OpticsStatus::ok) {
    return 0.0;
  }
  return estimation::ellipse_log_odds(
      expected, {sighting.semi_major_px, sighting.semi_minor_px, sighting.angle_rad});
}

}  // namespace

double ellipse_log_odds_of_dot(std::span<const CameraView> views, const Finalist& finalist,
                               const core::TargetDot& dot, const core::Pose& pose) {
  if (!dot.normal) return 0.0;
  const Eigen::Vector3d centre_m = pose.orientation * dot.position_m + pose.position_m;
  const Eigen::Vector3d normal = pose.orientation * *dot.normal;
  double sum = 0.0;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!finalist.cameras.contains(camera)) continue;
    const estimation::Sighting& sighting = views[camera].sightings[finalist.sighting[camera]];
    sum += log_odds_of_view(views[camera], sighting, centre_m, normal, 0.5 * dot.diameter_m);
  }
  return std::clamp(sum, kMostAgainstDot, kMostForDot);
}

}  // namespace dottrack::acquisition
