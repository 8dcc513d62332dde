#include "app/core/geometry/projected_circle.h"

#include <algorithm>
#include <cmath>

namespace dottrack::geometry {

// The disc's points are centre + radius * (unit vectors of its plane), so that the derivatives
// carry the plane's unit circle to an ellipse of the square form J (I - n n') J'.
ImageEllipse disc_ellipse(const ProjectionJacobian& jacobian, const Eigen::Vector3d& normal,
                          double radius_m) noexcept {
  const Eigen::Vector2d along_normal = jacobian * normal;
  const double xx = jacobian.row(0).squaredNorm() - along_normal.x() * along_normal.x();
  const double yy = jacobian.row(1).squaredNorm() - along_normal.y() * along_normal.y();
  const double xy = jacobian.row(0).dot(jacobian.row(1)) - along_normal.x() * along_normal.y();
  const double middle = 0.5 * (xx + yy);
  const double half_difference = 0.5 * (xx - yy);
  const double spread = std::sqrt(half_difference * half_difference + xy * xy);
  ImageEllipse ellipse;
  ellipse.semi_major_px = radius_m * std::sqrt(std::max(middle + spread, 0.0));
  ellipse.semi_minor_px = radius_m * std::sqrt(std::max(middle - spread, 0.0));
  ellipse.angle_rad = 0.5 * std::atan2(xy + 0.0, half_difference);  // -0 counts as 0
  return ellipse;
}

OpticsStatus project_disc(const CameraModel& model, const Eigen::Vector3d& centre_m,
                          const Eigen::Vector3d& normal, double radius_m,
                          ImageEllipse& ellipse) noexcept {
  Eigen::Vector2d pixel;
  ProjectionJacobian jacobian;
  const OpticsStatus status = project(model, centre_m, pixel, &jacobian);
  if (status == OpticsStatus::ok) ellipse = disc_ellipse(jacobian, normal, radius_m);
  return status;
}

double facing(const CameraModel& model, const Eigen::Vector3d& centre_m,
              const Eigen::Vector3d& normal) noexcept {
  const Eigen::Vector3d to_camera = centre(model) - centre_m;
  const double range_m = to_camera.norm();
  return range_m > 0.0 ? normal.dot(to_camera) / range_m : 0.0;
}

}  // namespace dottrack::geometry
