#include "app/core/geometry/triangulation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace dottrack::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMinSpread = 1e-9;  // mean squared sine between the lines and their mean direction

struct Normal {
  Matrix3d c = Matrix3d::Zero();
  Vector3d e = Vector3d::Zero();
};

// For a unit u the appendix's fourth-power terms collapse: the derivative of d^2/2 is (I - uu^T)(p
// - b).
Matrix3d perpendicular(const Ray& ray) {
  return Matrix3d::Identity() - ray.direction * ray.direction.transpose();
}

void add(Normal& normal, const Ray& ray, double weight) {
  const Matrix3d c = weight * perpendicular(ray);
  normal.c += c;
  normal.e += c * ray.origin;
}

bool well_spread(const Matrix3d& c, std::size_t lines) {
  const auto n = static_cast<double>(lines);
  return c.determinant() > kMinSpread * n * n * n;
}

double inverse_square_range(const Ray& ray, const Vector3d& point) {
  return 1.0 / std::max((point - ray.origin).squaredNorm(), 1e-12);
}

// Covariance of the weighted solution when each line's offset at the point is sigma * range.
Matrix3d propagate(std::span<const SightLine> lines, const Vector3d& point, const Matrix3d& c_inv) {
  Matrix3d middle = Matrix3d::Zero();
  for (const SightLine& line : lines) {
    const double weight = inverse_square_range(line.ray, point);
    middle += weight * line.sigma_rad * line.sigma_rad * perpendicular(line.ray);
  }
  return c_inv * middle * c_inv;
}

double rms_miss(std::span<const SightLine> lines, const Vector3d& point) {
  double sum = 0.0;
  for (const SightLine& line : lines) {
    sum += (point - line.ray.origin).cross(line.ray.direction).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(lines.size()));
}

}  // namespace

TriangulationStatus triangulate(std::span<const SightLine> lines, Triangulation& result) {
  if (lines.size() < 2) return TriangulationStatus::too_few_lines;
  Normal uniform;
  for (const SightLine& line : lines) add(uniform, line.ray, 1.0);
  if (!well_spread(uniform.c, lines.size())) return TriangulationStatus::degenerate;
  const Vector3d first = uniform.c.inverse() * uniform.e;

  Normal weighted;
  for (const SightLine& line : lines)
    add(weighted, line.ray, inverse_square_range(line.ray, first));
  const Matrix3d c_inv = weighted.c.inverse();
  result.point_m = c_inv * weighted.e;
  result.covariance_m2 = propagate(lines, result.point_m, c_inv);
  result.rms_miss_m = rms_miss(lines, result.point_m);
  return TriangulationStatus::ok;
}

}  // namespace dottrack::geometry
