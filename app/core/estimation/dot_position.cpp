#include "app/core/estimation/dot_position.h"

#include <limits>

namespace dottrack::estimation {
namespace {

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
  } while (drop_worst(views, result.point_m));
  position.position_m = result.point_m;
  position.covariance_m2 = result.covariance_m2;
  position.diameter_m = mean_diameter(views, result.point_m);
  position.cameras = CameraSet{};
  for (const View& view : views) position.cameras.insert(view.camera);
  return true;
}

}  // namespace dottrack::estimation
