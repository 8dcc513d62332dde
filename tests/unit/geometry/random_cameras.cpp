#include "tests/unit/geometry/random_cameras.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace dottrack::test {

using Eigen::Vector3d;

Vector3d RandomCameras::unit() {
  for (;;) {
    const Vector3d v(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

Vector3d RandomCameras::nearly_unit(const Vector3d& direction) {
  return direction.normalized() * (1.0 + between(-1e-5, 1e-5));
}

geometry::Cahv RandomCameras::cahv() {
  const Vector3d a = unit();
  const Vector3d right = a.cross(unit()).normalized();
  const Vector3d down = a.cross(right) + 0.01 * between(-1.0, 1.0) * right;
  const double scale_px = between(300.0, 1500.0);
  const double mirror = between(0.0, 1.0) < 0.2 ? -1.0 : 1.0;
  geometry::Cahv m;
  m.c = 10.0 * Vector3d(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
  m.a = nearly_unit(a);
  m.h = mirror * scale_px * right + between(300.0, 340.0) * a;
  m.v = scale_px * between(0.98, 1.02) * down + between(220.0, 260.0) * a;
  return m;
}

geometry::Cahvor RandomCameras::cahvor() {
  const geometry::Cahv linear = cahv();
  const Vector3d o = nearly_unit(linear.a + 0.02 * unit());
  const Vector3d r(between(-2e-3, 2e-3), between(-0.25, 0.1), between(0.0, 0.05));
  return {linear.c, linear.a, linear.h, linear.v, o, r};
}

geometry::Cahvore RandomCameras::cahvore(double linearity) {
  const geometry::Cahv linear = cahv();
  const Vector3d o = nearly_unit(linear.a + 0.02 * unit());
  const Vector3d r(between(-2e-3, 2e-3), between(-0.03, 0.03), between(-2e-3, 2e-3));
  const Vector3d e(between(-5e-3, 5e-3), between(-2e-3, 2e-3), between(-5e-4, 5e-4));
  return {linear.c, linear.a, linear.h, linear.v, o, r, e, linearity};
}

Vector3d RandomCameras::point_near(const Vector3d& centre, const Vector3d& axis,
                                   double largest_angle_rad, double nearest_m, double farthest_m) {
  const Vector3d along = axis.normalized();
  const Vector3d across = along.cross(unit()).normalized();
  const double angle = between(0.0, largest_angle_rad);
  return centre +
         between(nearest_m, farthest_m) * (std::cos(angle) * along + std::sin(angle) * across);
}

}  // namespace dottrack::test
