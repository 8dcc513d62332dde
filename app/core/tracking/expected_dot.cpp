#include "app/core/tracking/expected_dot.h"

#include "app/core/estimation/dot_size.h"

namespace dottrack::tracking {
namespace {

// At 84 degrees from its normal a disc is a line, and printed dots do not shine there.
constexpr double kMinFacing = 0.1;

bool inside(const core::Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= camera.width_px - 0.5 &&
         pixel.y() <= camera.height_px - 0.5;
}

}  // namespace

PlacedDot placed(const core::TargetDot& dot, const core::Pose& pose) {
  PlacedDot result;
  result.place_m = pose.orientation * dot.position_m + pose.position_m;
  if (dot.normal) result.normal = pose.orientation * *dot.normal;
  result.diameter_m = dot.diameter_m;
  return result;
}

Eigen::Vector3d way_of(const Expectation& expected, const PlacedDot& dot, double after_s) {
  if (!expected.moving) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d lever = dot.place_m - expected.pose.position_m;
  return after_s * (expected.motion.velocity_m_s + expected.motion.turn_rad_s.cross(lever));
}

bool faces(const core::Camera& camera, const PlacedDot& dot) {
  return !dot.has_normal() || geometry::facing(camera.model, dot.place_m, dot.normal) >= kMinFacing;
}

bool expect(const core::Camera& camera, const geometry::Optics& optics, const PlacedDot& dot,
            ExpectedDot& expected) {
  const double range_m = (dot.place_m - geometry::centre(camera.model)).norm();
  if (range_m < camera.distance_min_m || range_m > camera.distance_max_m || !faces(camera, dot)) {
    return false;
  }
  geometry::ProjectionJacobian jacobian;
  if (geometry::project(camera.model, dot.place_m, expected.pixel, &jacobian) !=
          geometry::OpticsStatus::ok ||
      !inside(camera, expected.pixel)) {
    return false;
  }
  const geometry::AngularScale& scale = optics.at(expected.pixel);
  if (scale.max_px <= 0.0) return false;
  expected.pixels_per_m = scale.max_px / range_m;
  expected.radius_px = 0.5 * dot.diameter_m * expected.pixels_per_m;
  expected.gate = estimation::dot_gate(
      camera, estimation::expected_semi_major({dot.diameter_m, dot.diameter_m}, range_m, scale));
  expected.has_ellipse = dot.has_normal();
  if (expected.has_ellipse) {
    expected.ellipse = geometry::disc_ellipse(jacobian, dot.normal, 0.5 * dot.diameter_m);
  }
  return true;
}

}  // namespace dottrack::tracking
