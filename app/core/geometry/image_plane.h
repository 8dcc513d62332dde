#pragma once
// What all three models share: the image plane that A, H and V span.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dottrack::geometry {

// The direction through a pixel before any distortion is undone, and its derivatives by x and y.
// Not of unit length; direction.a is positive, or zero where A, H and V do not span an image.
struct PlaneDirection {
  Eigen::Vector3d direction;
  double sign;  // -1 where H and V turn the other way (a mirrored image), else +1
};

template <class Model>
PlaneDirection through_pixel(const Model& m, const Eigen::Vector2d& pixel) noexcept {
  const double sign = m.v.cross(m.h).dot(m.a) < 0.0 ? -1.0 : 1.0;
  return {sign * (m.v - pixel.y() * m.a).cross(m.h - pixel.x() * m.a), sign};
}

// d(direction)/d(x, y), which no pixel changes.
template <class Model>
Eigen::Matrix<double, 3, 2> plane_jacobian(const Model& m, double sign) noexcept {
  Eigen::Matrix<double, 3, 2> jacobian;
  jacobian.col(0) = sign * m.a.cross(m.v);
  jacobian.col(1) = sign * m.h.cross(m.a);
  return jacobian;
}

// d(v / |v|) from dv, given u = v / |v|: the part across u, scaled.
inline Eigen::Matrix<double, 3, 2> normalised_jacobian(const Eigen::Vector3d& u, double length,
                                                       const Eigen::Matrix<double, 3, 2>& dv) {
  Eigen::Matrix<double, 3, 2> jacobian;
  jacobian.col(0) = (dv.col(0) - u.dot(dv.col(0)) * u) / length;
  jacobian.col(1) = (dv.col(1) - u.dot(dv.col(1)) * u) / length;
  return jacobian;
}

}  // namespace dottrack::geometry
