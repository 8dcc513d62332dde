#include "app/core/geometry/projected_circle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::geometry {
namespace {

// Sum of where two opposite points of the rim are shown, from the centre's pixel: the curvature
// along their line, times the radius squared.
bool curvature(const CameraModel& model, const Eigen::Vector3d& centre_m,
               const Eigen::Vector2d& pixel, const Eigen::Vector3d& to_rim_m,
               Eigen::Vector2d& bend) {
  Eigen::Vector2d ahead;
  Eigen::Vector2d behind;
  if (project(model, centre_m + to_rim_m, ahead) != OpticsStatus::ok ||
      project(model, centre_m - to_rim_m, behind) != OpticsStatus::ok) {
    return false;
  }
  bend = (ahead - pixel) + (behind - pixel);
  return true;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

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

// On the disc a point is s u + t w from the centre, |(s, t)| up to 1; it is shown at
// a s + b t + (uu s^2 + 2 uw s t + ww t^2) / 2. Its mean is weighed by the area that is shown of
// the disc there, the map's determinant; s^2 and t^2 are 1/4 on average.
Eigen::Vector2d disc_eccentricity(const CameraModel& model, const Eigen::Vector3d& centre_m,
                                  const Eigen::Vector2d& pixel, const ProjectionJacobian& jacobian,
                                  const Eigen::Vector3d& normal, double radius_m) noexcept {
  const Eigen::Vector3d u = radius_m * normal.unitOrthogonal();
  const Eigen::Vector3d w = normal.cross(u);
  Eigen::Vector2d uu;
  Eigen::Vector2d ww;
  Eigen::Vector2d diagonal;
  if (!curvature(model, centre_m, pixel, u, uu) || !curvature(model, centre_m, pixel, w, ww) ||
      !curvature(model, centre_m, pixel, std::sqrt(0.5) * (u + w), diagonal)) {
    return Eigen::Vector2d::Zero();
  }
  const Eigen::Vector2d uw = diagonal - 0.5 * (uu + ww);
  const Eigen::Vector2d a = jacobian * u;
  const Eigen::Vector2d b = jacobian * w;
  const double area = cross(a, b);
  const double along_s = (cross(uu, b) + cross(a, uw)) / area;
  const double along_t = (cross(uw, b) + cross(a, ww)) / area;
  return std::abs(area) > 1e-9
             ? Eigen::Vector2d(0.125 * (uu + ww) + 0.25 * (along_s * a + along_t * b))
             : Eigen::Vector2d::Zero();
}

double facing(const CameraModel& model, const Eigen::Vector3d& centre_m,
              const Eigen::Vector3d& normal) noexcept {
  const Eigen::Vector3d to_camera = centre(model) - centre_m;
  const double range_m = to_camera.norm();
  return range_m > 0.0 ? normal.dot(to_camera) / range_m : 0.0;
}

}  // namespace dottrack::geometry
