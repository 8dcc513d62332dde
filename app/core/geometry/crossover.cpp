#include "app/core/geometry/crossover.h"

namespace dottrack::geometry {

namespace {
constexpr double kMinSine2 = 1e-10;  // of the angle between the lines
}

CrossoverStatus closest_crossover(const Ray& a, const Ray& b, Crossover& crossover) {
  const Eigen::Vector3d baseline = b.origin - a.origin;
  const double cosine = a.direction.dot(b.direction);
  const double sine2 = 1.0 - cosine * cosine;
  if (!(sine2 > kMinSine2)) return CrossoverStatus::collinear;
  const double along_a = baseline.dot(a.direction);
  const double along_b = baseline.dot(b.direction);
  const double range_a = (along_a - cosine * along_b) / sine2;
  const double range_b = (cosine * along_a - along_b) / sine2;
  if (!(range_a > 0.0 && range_b > 0.0)) return CrossoverStatus::behind;
  const Eigen::Vector3d on_a = a.origin + range_a * a.direction;
  const Eigen::Vector3d on_b = b.origin + range_b * b.direction;
  crossover.point_m = 0.5 * (on_a + on_b);
  crossover.miss_m = (on_b - on_a).norm();
  crossover.range_a_m = range_a;
  crossover.range_b_m = range_b;
  return CrossoverStatus::ok;
}

}  // namespace dottrack::geometry
