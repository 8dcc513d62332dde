#include "app/core/geometry/triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMinSpread = 1e-9;  // mean squared sine between the lines and their mean direction

// A symmetric matrix. Spelled out: acquisition solves for hundreds of points in a tick.
struct Symmetric {
  double xx = 0.0;
  double xy = 0.0;
  double xz = 0.0;
  double yy = 0.0;
  double yz = 0.0;
  double zz = 0.0;

  // Adds weight * (I - u u^T). For a unit u the appendix's fourth-power terms collapse to this: the
  // derivative of d^2/2 is (I - uu^T)(p - b).
  void add_perpendicular(const Vector3d& u, double weight) {
    const double x = weight * u.x();
    const double y = weight * u.y();
    xx += weight - x * u.x();
    xy -= x * u.y();
    xz -= x * u.z();
    yy += weight - y * u.y();
    yz -= y * u.z();
    zz += weight - weight * u.z() * u.z();
  }

  Symmetric adjugate() const {
    return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
            xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  }

  // By the adjugate.
  double determinant(const Symmetric& a) const { return xx * a.xx + xy * a.xy + xz * a.xz; }

  Symmetric scaled(double s) const { return {s * xx, s * xy, s * xz, s * yy, s * yz, s * zz}; }

  Vector3d operator*(const Vector3d& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }

  Matrix3d full() const {
    Matrix3d m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }
};

// The normal equations c p = e.
struct Normal {
  Symmetric c;
  Vector3d e = Vector3d::Zero();

  void add(const Ray& ray, double weight) {
    c.add_perpendicular(ray.direction, weight);
    const double along = ray.direction.dot(ray.origin);
    e += weight * (ray.origin - along * ray.direction);
  }
};

double inverse_square_range(const Ray& ray, const Vector3d& point) {
  return 1.0 / std::max((point - ray.origin).squaredNorm(), 1e-12);
}

// Covariance of the weighted solution when each line's offset at the point is sigma * range, and
// the lines' distances to the point.
void judge(std::span<const SightLine> lines, const Symmetric& c_inv, Triangulation& result) {
  Symmetric middle;
  double miss2 = 0.0;
  for (const SightLine& line : lines) {
    const Vector3d offset = result.point_m - line.ray.origin;
    const double weight = 1.0 / std::max(offset.squaredNorm(), 1e-12);
    middle.add_perpendicular(line.ray.direction, weight * line.sigma_rad * line.sigma_rad);
    miss2 += offset.cross(line.ray.direction).squaredNorm();
  }
  const Matrix3d inverse = c_inv.full();
  result.covariance_m2 = inverse * middle.full() * inverse;
  result.rms_miss_m = std::sqrt(miss2 / static_cast<double>(lines.size()));
}

}  // namespace

TriangulationStatus triangulate(std::span<const SightLine> lines, Triangulation& result) {
  if (lines.size() < 2) return TriangulationStatus::too_few_lines;
  Normal uniform;
  for (const SightLine& line : lines) uniform.add(line.ray, 1.0);
  const Symmetric adjugate = uniform.c.adjugate();
  const double spread = uniform.c.determinant(adjugate);
  const auto n = static_cast<double>(lines.size());
  if (!(spread > kMinSpread * n * n * n)) return TriangulationStatus::degenerate;
  const Vector3d first = adjugate * uniform.e / spread;

  Normal weighted;
  for (const SightLine& line : lines) {
    weighted.add(line.ray, inverse_square_range(line.ray, first));
  }
  const Symmetric weighted_adjugate = weighted.c.adjugate();
  const Symmetric c_inv = weighted_adjugate.scaled(1.0 / weighted.c.determinant(weighted_adjugate));
  result.point_m = c_inv * weighted.e;
  judge(lines, c_inv, result);
  return TriangulationStatus::ok;
}

}  // namespace dottrack::geometry
