#include "app/core/estimation/dot_position.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dottrack::estimation {
namespace {

// With three views left to agree, an odd fourth can be told; of three, none can.
constexpr std::size_t kMinViewsToJudge = 4;
constexpr double kOddView_px = 0.2;  // a smaller residual does no harm
constexpr double kMinFRatio = 40.0;  // by chance in less than one of a hundred dots

bool solve(const Views& views, geometry::Triangulation& result) {
  StaticVector<geometry::SightLine, kMaxCameras> lines;
  for (const View& view : views) {
    lines.push_back(view.sighting->line);
    lines.back().ray.origin -= view.moved_m;
  }
  return geometry::triangulate(as_span(lines), result) == geometry::TriangulationStatus::ok;
}

// The linear projection of a point near a line of sight is off by less than this, pixels.
constexpr double kLinearError_px = 0.25;
constexpr double kNearLine_px = 4.0;

// What the views make of a point: where it projects to, linearly.
struct Residuals {
  StaticVector<double, kMaxCameras> squared_px;
  std::size_t worst = 0;
  double sum2_px = 0.0;
  bool inside_all = true;  // of the bounding boxes, beyond doubt
};

bool clearly_inside(const Sighting& sighting, const Eigen::Vector2d& pixel) {
  return pixel.x() > sighting.box_min_px.x() + kLinearError_px &&
         pixel.y() > sighting.box_min_px.y() + kLinearError_px &&
         pixel.x() < sighting.box_max_px.x() - kLinearError_px &&
         pixel.y() < sighting.box_max_px.y() - kLinearError_px;
}

Residuals residuals_of(const Views& views, const Eigen::Vector3d& point_m) {
  Residuals result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Sighting& sighting = *views[i].sighting;
    const Eigen::Vector2d pixel = views[i].pixel_of(point_m);
    const double squared = (pixel - sighting.pixel).squaredNorm();
    result.squared_px.push_back(squared);
    result.sum2_px += squared;
    if (squared > result.squared_px[result.worst]) result.worst = i;
    result.inside_all = result.inside_all && squared < kNearLine_px * kNearLine_px &&
                        clearly_inside(sighting, pixel);
  }
  return result;
}

// How far outside the view's bounding box the point projects: 0 inside, in box sizes outside.
double excess(const View& view, const Eigen::Vector3d& point_m) {
  Eigen::Vector2d pixel;
  if (geometry::project(view.model->model, point_m + view.moved_m, pixel) !=
      geometry::OpticsStatus::ok) {
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

// A dot half behind a mast has its centroid off by a pixel while the other views agree to
// hundredths. Removes the view that fits worst when the rest fit far better without it: by an F
// test of the two coordinates it takes along; `result` and `residuals` are then those of the rest.
// False when no view is that odd.
bool drop_outlier(Views& views, geometry::Triangulation& result, Residuals& residuals) {
  if (views.size() < kMinViewsToJudge) return false;
  if (residuals.squared_px[residuals.worst] < kOddView_px * kOddView_px) return false;
  Views rest = views;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(residuals.worst));
  geometry::Triangulation without;
  if (!solve(rest, without)) return false;
  const Residuals left = residuals_of(rest, without.point_m);
  const double left2 = left.sum2_px;
  const double gained2 = residuals.sum2_px - left2;
  const double freedom = 2.0 * static_cast<double>(rest.size()) - 3.0;
  if (gained2 / 2.0 < kMinFRatio * left2 / freedom) return false;
  views = rest;
  result = without;
  residuals = left;
  return true;
}

// Drops a view that misses (true: the rest is to be solved anew), or else those that stand out, one
// after the other, whose rest is solved already. False when what is left agrees.
bool drop_disagreeing(Views& views, geometry::Triangulation& result, Residuals& residuals) {
  do {
    if (!residuals.inside_all && drop_worst(views, result.point_m)) return true;
  } while (drop_outlier(views, result, residuals));
  return false;
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
  Residuals residuals;
  do {
    if (views.size() < 2 || !solve(views, result)) return false;
    residuals = residuals_of(views, result.point_m);
  } while (drop_disagreeing(views, result, residuals));
  position.position_m = result.point_m;
  position.covariance_m2 = result.covariance_m2;
  position.diameter_m = mean_diameter(views, result.point_m);
  position.worst_residual_px = std::sqrt(residuals.squared_px[residuals.worst]);
  position.cameras = CameraSet{};
  for (const View& view : views) position.cameras.insert(view.camera);
  return true;
}

}  // namespace dottrack::estimation
