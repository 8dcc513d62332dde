#include "app/core/tracking/shared_light.h"

#include <Eigen/LU>
#include <algorithm>

#include "app/core/estimation/sighting.h"

namespace dottrack::tracking {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Chi-square of 2 degrees of freedom: 2 on average where there is no slope.
constexpr double kNoise = 4.0;
// How well a slope can be known at all: its change over the dot's radius, as a part of the
// contrast.
constexpr double kLeastSigma = 0.005;

// From a slope in the dot's plane, a part of the contrast each metre, to one in the image.
using PlaneToImage = Matrix2d;

// A step d in the plane is J d in the image, so a slope G there is J^-T G here.
bool plane_to_image(const PlacedDot& dot, const estimation::Sighting& sighting, PlaneToImage& map) {
  const Eigen::Vector3d u = dot.normal.unitOrthogonal();
  const Eigen::Vector3d w = dot.normal.cross(u);
  const double range_m = (dot.place_m - sighting.line.ray.origin).dot(sighting.line.ray.direction);
  Matrix2d jacobian = Matrix2d::Zero();
  jacobian << sighting.pixels_per_rad * u, sighting.pixels_per_rad * w;
  jacobian /= range_m;
  bool invertible = false;
  Matrix2d inverse = Matrix2d::Zero();
  jacobian.computeInverseWithCheck(inverse, invertible, 1e-3);
  map = inverse.transpose();
  return invertible;
}

// Information on the slope that a view shows.
Matrix2d weight_of(const SeenDot& seen) {
  const double radius_px = seen.region.semi_minor_px;
  const double least = kLeastSigma / radius_px;
  const Matrix2d& information = seen.light.information_px2;
  return (Matrix2d::Identity() + least * least * information).inverse() * information;
}

// The slope of the light on one dot.
class Slope {
 public:
  void add(const PlaneToImage& map, const Matrix2d& weight, const Vector2d& slope_per_px) {
    information_ += map.transpose() * weight * map;
    gradient_ += map.transpose() * weight * slope_per_px;
    square_ += slope_per_px.dot(weight * slope_per_px);
    ++views_;
  }

  bool solve() {
    if (views_ < 2 || !(information_.determinant() > 0.0)) return false;
    covariance_ = information_.inverse();
    per_m_ = covariance_ * gradient_;
    const double explained = per_m_.dot(gradient_);
    const double scale = std::max(1.0, (square_ - explained) / (2.0 * (views_ - 1)));
    covariance_ *= scale;
    part_ = std::max(0.0, 1.0 - kNoise * scale / explained);
    return part_ > 0.0;
  }

  int views() const { return views_; }
  Vector2d per_m() const { return part_ * per_m_; }
  Matrix2d covariance() const { return part_ * covariance_; }

 private:
  Matrix2d information_ = Matrix2d::Zero();
  Vector2d gradient_ = Vector2d::Zero();
  double square_ = 0.0;
  int views_ = 0;
  Vector2d per_m_ = Vector2d::Zero();
  Matrix2d covariance_ = Matrix2d::Zero();
  double part_ = 0.0;  // of it that is believed
};

bool shows_light(const SeenDot& seen) {
  const Matrix2d& information = seen.light.information_px2;
  return (seen.flaw == core::DotFlaw::none || seen.light.explains) && information(0, 0) > 0.0 &&
         information.determinant() > 0.0 && seen.light.slope_per_px.allFinite();
}

// The uncertainty is one and the same for all views: it does not average out.
bool move(const core::Camera& camera, const PlaneToImage& map, const Slope& slope, SeenDot& seen) {
  const Matrix2d by_slope = seen.light.centre_by_slope_px2 * map;
  seen.region.centroid_px -= by_slope * slope.per_m();
  if (seen.light.explains) {
    seen.flaw = core::DotFlaw::none;
    seen.covariance_px2 = seen.light.covariance_px2;
  }
  seen.covariance_px2 += slope.views() * (by_slope * slope.covariance() * by_slope.transpose());
  seen.sighting.pixel = seen.region.centroid_px;
  return estimation::add_line_of_sight(camera, seen.sighting);
}

}  // namespace

void take_out_uneven_light(const core::Rig& rig, const PlacedDots& placed, SeenDots& seen) {
  for (std::size_t dot = 0; dot < rig.target.dots.size(); ++dot) {
    if (!placed[dot].has_normal()) continue;
    Slope slope;
    PlaneToImage map;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
      const SeenDot& view = seen.by_camera[camera][dot];
      if (!seen.counts(camera, dot) || !shows_light(view)) continue;
      if (!plane_to_image(placed[dot], view.sighting, map)) continue;
      slope.add(map, weight_of(view), view.light.slope_per_px);
    }
    if (!slope.solve()) continue;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
      SeenDot& view = seen.by_camera[camera][dot];
      if (!view.any || !shows_light(view) || !plane_to_image(placed[dot], view.sighting, map)) {
        continue;
      }
      view.any = move(rig.cameras[camera], map, slope, view);
    }
  }
}

}  // namespace dottrack::tracking
