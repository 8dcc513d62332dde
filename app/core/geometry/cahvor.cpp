#include "app/core/geometry/cahvor.h"

#include <cmath>

#include "app/core/geometry/image_plane.h"
#include "app/core/geometry/radial.h"
#include "app/core/geometry/refusal.h"

namespace dottrack::geometry {
namespace {

// A point on its way into the image.
struct Distorted {
  Eigen::Vector3d l;      // across the optical axis, metres
  Eigen::Vector3d point;  // d'
  double w;               // along the optical axis, metres
  double tau;             // square of the tangent of the angle to the axis
  double mu;
  double range;  // of d' along A
};

OpticsStatus distort(const Cahvor& m, const Eigen::Vector3d& d, Distorted& out) noexcept {
  const double squared_length = d.squaredNorm();
  out.w = d.dot(m.o);
  if (!clearly_in_front(out.w, squared_length) || !clearly_in_front(d.dot(m.a), squared_length)) {
    return refuse_point(d, OpticsStatus::behind);
  }
  out.l = d - out.w * m.o;
  out.tau = out.l.squaredNorm() / (out.w * out.w);
  if (!RadialPolynomial{1.0 + m.r.x(), m.r.y(), m.r.z()}.rises_to_square(out.tau)) {
    return refuse_point(d, OpticsStatus::outside_domain);
  }
  out.mu = m.r.x() + out.tau * (m.r.y() + out.tau * m.r.z());
  out.point = d + out.mu * out.l;
  out.range = out.point.dot(m.a);
  return out.range > 0.0 ? OpticsStatus::ok : refuse_point(d, OpticsStatus::outside_domain);
}

// What one image coordinate gains from a step of the point, n being its gradient by d'.
Eigen::RowVector3d back_through_distortion(const Cahvor& m, const Distorted& f,
                                           const Eigen::Vector3d& dmu, const Eigen::Vector3d& n) {
  return ((1.0 + f.mu) * n - (f.mu * n.dot(m.o)) * m.o + n.dot(f.l) * dmu).transpose();
}

Eigen::Vector3d gradient_of_mu(const Cahvor& m, const Distorted& f) {
  const Eigen::Vector3d dl = f.l - f.l.dot(m.o) * m.o;  // l.l is of d, half its gradient
  const double dmu_dtau = m.r.y() + 2.0 * f.tau * m.r.z();
  return (2.0 * dmu_dtau / f.w) * (dl / f.w - f.tau * m.o);
}

}  // namespace

OpticsStatus project(const Cahvor& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian) noexcept {
  Distorted f;
  const OpticsStatus status = distort(model, p_world - model.c, f);
  if (status != OpticsStatus::ok) return status;
  const double x = f.point.dot(model.h) / f.range;
  const double y = f.point.dot(model.v) / f.range;
  if (!std::isfinite(x + y)) return OpticsStatus::not_finite;
  pixel = {x, y};
  if (jacobian != nullptr) {
    const Eigen::Vector3d dmu = gradient_of_mu(model, f);
    jacobian->row(0) = back_through_distortion(model, f, dmu, (model.h - x * model.a) / f.range);
    jacobian->row(1) = back_through_distortion(model, f, dmu, (model.v - y * model.a) / f.range);
  }
  return OpticsStatus::ok;
}

namespace {

// A pixel's direction on its way out: across and along the axis, and how far it shrinks.
struct Undistorted {
  PlaneDirection plane;
  Eigen::Vector3d l;
  double w;
  double tau;
  double u;  // undistorted over distorted radius
};

OpticsStatus undistort(const Cahvor& m, const Eigen::Vector2d& pixel, Undistorted& out) noexcept {
  out.plane = through_pixel(m, pixel);
  const Eigen::Vector3d& g = out.plane.direction;
  out.w = g.dot(m.o);
  if (!(g.dot(m.a) > 0.0) || !(out.w > 0.0)) return refuse_pixel(pixel);
  out.l = g - out.w * m.o;
  out.tau = out.l.squaredNorm() / (out.w * out.w);
  if (!std::isfinite(out.tau)) return OpticsStatus::not_finite;
  const RadialPolynomial shrinking{1.0 + m.r.x(), m.r.y() * out.tau, m.r.z() * out.tau * out.tau};
  const double grown = shrinking.value(1.0);
  return invert(shrinking, 1.0, grown > 0.5 ? 1.0 / grown : 1.0, out.u);
}

// d(w O + u l)/d(x, y)
Eigen::Matrix<double, 3, 2> undistorted_jacobian(const Cahvor& m, const Undistorted& f) {
  const double u2 = f.u * f.u;
  const double slope =
      RadialPolynomial{1.0 + m.r.x(), m.r.y(), m.r.z()}.slope_at_square(u2 * f.tau);
  const double du_dtau = -f.u * u2 * (m.r.y() + 2.0 * m.r.z() * f.tau * u2) / slope;
  Eigen::Matrix<double, 3, 2> jacobian = plane_jacobian(m, f.plane.sign);
  for (int i = 0; i < 2; ++i) {
    const double dw = jacobian.col(i).dot(m.o);
    const Eigen::Vector3d dl = jacobian.col(i) - dw * m.o;
    const double dtau = 2.0 * (f.l.dot(dl) / f.w - f.tau * dw) / f.w;
    jacobian.col(i) = dw * m.o + f.u * dl + (du_dtau * dtau) * f.l;
  }
  return jacobian;
}

}  // namespace

OpticsStatus unproject(const Cahvor& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian) noexcept {
  Undistorted f;
  const OpticsStatus status = undistort(model, pixel, f);
  if (status != OpticsStatus::ok) return status;
  const Eigen::Vector3d along = f.w * model.o + f.u * f.l;
  const double length = along.norm();
  if (!std::isfinite(length)) return OpticsStatus::not_finite;
  if (!clearly_in_front(along.dot(model.a) / length, 1.0)) return OpticsStatus::outside_domain;
  ray.origin = model.c;
  ray.direction = along / length;
  if (jacobian != nullptr) {
    jacobian->origin.setZero();
    jacobian->direction =
        normalised_jacobian(ray.direction, length, undistorted_jacobian(model, f));
  }
  return OpticsStatus::ok;
}

}  // namespace dottrack::geometry
