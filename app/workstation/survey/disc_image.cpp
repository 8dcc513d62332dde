#include "app/workstation/survey/disc_image.h"

#include <array>
#include <cmath>

namespace dottrack::workstation {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<Vector2d> disc_image_centre(const geometry::CameraModel& model,
                                          const Vector3d& centre_m, const Vector3d& normal,
                                          double radius_m) {
  constexpr int kCorners = 32;
  Vector2d middle;
  if (geometry::project(model, centre_m, middle) != geometry::OpticsStatus::ok) return std::nullopt;
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  std::array<Vector2d, kCorners> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    const Vector3d p = centre_m + radius_m * (std::cos(angle) * u + std::sin(angle) * v);
    Vector2d& corner = rim[static_cast<std::size_t>(i)];
    if (geometry::project(model, p, corner) != geometry::OpticsStatus::ok) return std::nullopt;
    corner -= middle;
  }
  double area = 0.0;
  Vector2d moment = Vector2d::Zero();
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector2d& a = rim[i];
    const Vector2d& b = rim[(i + 1) % rim.size()];
    const double twice = a.x() * b.y() - a.y() * b.x();
    area += 0.5 * twice;
    moment += twice * (a + b) / 6.0;
  }
  if (area == 0.0) return std::nullopt;
  return middle + moment / area;
}

Vector2d eccentricity_px(const geometry::CameraModel& model, const core::TargetDot& dot,
                         const core::Pose& pose) {
  if (!dot.normal) return Vector2d::Zero();
  const Vector3d place = pose.orientation * dot.position_m + pose.position_m;
  Vector2d middle;
  const auto centre =
      disc_image_centre(model, place, pose.orientation * *dot.normal, 0.5 * dot.diameter_m);
  if (!centre || geometry::project(model, place, middle) != geometry::OpticsStatus::ok) {
    return Vector2d::Zero();
  }
  return *centre - middle;
}

}  // namespace dottrack::workstation
