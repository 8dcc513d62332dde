#include "app/core/estimation/dot_position.h"

#include <algorithm>
#include <limits>

namespace dottrack::estimation {
namespace {

// With three views left to agree, an odd fourth can be told; of three, none can.
constexpr std::size_t kMinViewsToJudge = 4;
constexpr double kOddView_px = 0.2;  // a smaller residual does no harm
constexpr double kMinFRatio = 40.0;  // by chance in less than one of a hundred dots

bool solve(const Views& views, geometry::Triangulation& result) {
  StaticVector<geometry::SightLine, kMaxCameras> lines;
  for (const View& view : views) lines.push_back(view.sighting->line);
  return geometry::triangulate(as_span(lines), result) == geometry::TriangulationStatus::ok;
}

// How far outside the view's bounding box the point projects: 0 inside, in box sizes outside.
double excess(const View& view, const Eigen::Vector3d& point_m) {
  Eigen::Vector2d pixel;
  if (geometry::project(view.model->model, point_m, pixel) != geometry::OpticsStatus::ok) {
    return std::numeric_limits<double>::infinity();
  }
  const Sighting& sighting = *view.sighting;
  if (sighting.box_contains(pixel)) return 0.0;
  return (pixel - sighting.pixel).norm() / (sighting.box_max_px - sighting.box_min_px).norm();
}

// Removes the view that fits worst; false when every view fits.
bool drop_worst(Views& views, const Eigen::Vector3d& point_m) {
  double worst = 0.0;
  auto worst_view = views.end();
  for (auto view = views.begin(); view != views.end(); ++view) {
    const double e = excess(*view, point_m);
    if (e <= worst) continue;
    worst = e;
    worst_view = view;
  }
  if (worst_view == views.end()) return false;
  views.erase(worst_view);
  return true;
}

double residual2_px(const View& view, const Eigen::Vector3d& point_m) {
  return (view.sighting->pixel_of(point_m) - view.sighting->pixel).squaredNorm();
}

double sum_residual2_px(const Views& views, const Eigen::Vector3d& point_m) {
  double sum = 0.0;
  for (const View& view : views) sum += residual2_px(view, point_m);
  return sum;
}

// A dot half behind a mast has its centroid off by a pixel while the other views agree to
// hundredths. Removes the view that fits worst when the rest fit far better without it: by an F
// test of the two coordinates it takes along. False when no view is that odd.
bool drop_outlier(Views& views, const Eigen::Vector3d& point_m) {
  if (views.size() < kMinViewsToJudge) return false;
  const auto worst =
      std::max_element(views.begin(), views.end(), [&](const View& a, const View& b) {
        return residual2_px(a, point_m) < residual2_px(b, point_m);
      });
  if (residual2_px(*worst, point_m) < kOddView_px * kOddView_px) return false;
  Views rest = views;
  rest.erase(rest.begin() + (worst - views.begin()));
  geometry::Triangulation without;
  if (!solve(rest, without)) return false;
  const double left2 = sum_residual2_px(rest, without.point_m);
  const double gained2 = sum_residual2_px(views, point_m) - left2;
  const double freedom = 2.0 * static_cast<double>(rest.size()) - 3.0;
  if (gained2 / 2.0 < kMinFRatio * left2 / freedom) return false;
  views = rest;
  return true;
}

double mean_diameter(const Views& views, const Eigen::Vector3d& point_m) {
  double sum = 0.0;
  for (const View& view : views) {
    sum += view.sighting->angular_diameter_rad * (point_m - view.sighting->line.ray.origin).norm();
  }
  return sum / static_cast<double>(views.size());
}

}  // namespace

bool locate_dot(Views views, DotPosition& position) {
  geometry::Triangulation result;
  do {
    if (views.size() < 2 || !solve(views, result)) return false;
  } while (drop_worst(views, result.point_m) || drop_outlier(views, result.point_m));
  position.position_m = result.point_m;
  position.covariance_m2 = result.covariance_m2;
  position.diameter_m = mean_diameter(views, result.point_m);
  position.cameras = CameraSet{};
  for (const View& view : views) position.cameras.insert(view.camera);
  return true;
}

}  // namespace dottrack::estimation
