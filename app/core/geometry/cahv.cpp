#include "app/core/geometry/cahv.h"

#include <cmath>

#include "app/core/geometry/image_plane.h"
#include "app/core/geometry/refusal.h"

namespace dottrack::geometry {

OpticsStatus project(const Cahv& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian) noexcept {
  const Eigen::Vector3d d = p_world - model.c;
  const double range = d.dot(model.a);
  if (!clearly_in_front(range, d.squaredNorm())) return refuse_point(d, OpticsStatus::behind);
  const double column = d.dot(model.h);
  const double row = d.dot(model.v);
  const double x = column / range;
  const double y = row / range;
  if (!std::isfinite(x + y)) return OpticsStatus::not_finite;
  pixel = {x, y};
  if (jacobian != nullptr) {
    // Before the division, so that what is zero by symmetry comes out as zero.
    const double scale = 1.0 / (range * range);
    jacobian->row(0) = scale * (range * model.h - column * model.a).transpose();
    jacobian->row(1) = scale * (range * model.v - row * model.a).transpose();
  }
  return OpticsStatus::ok;
}

OpticsStatus unproject(const Cahv& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian) noexcept {
  const PlaneDirection plane = through_pixel(model, pixel);
  const double length = plane.direction.norm();
  if (!(plane.direction.dot(model.a) > 0.0) || !std::isfinite(length)) return refuse_pixel(pixel);
  ray.origin = model.c;
  ray.direction = plane.direction / length;
  if (jacobian != nullptr) {
    jacobian->origin.setZero();
    jacobian->direction =
        normalised_jacobian(ray.direction, length, plane_jacobian(model, plane.sign));
  }
  return OpticsStatus::ok;
}

}  // namespace dottrack::geometry
