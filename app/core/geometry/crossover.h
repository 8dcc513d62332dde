#pragma once
// Closest crossover of two lines of sight (paper section 3.1.3).

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

struct Crossover {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  // mean of the two closest points, world
  double miss_m = 0.0;                                // distance between the two closest points
  double range_a_m = 0.0;                             // along each ray to its closest point
  double range_b_m = 0.0;
};

enum class CrossoverStatus : std::uint8_t {
  ok,
  collinear,  // the lines are parallel within 1e-5 rad: no crossover worth the name
  behind,     // the closest points lie behind an origin
};

// The output is written only when the status is ok. Acquisition calls it for every pair of lines
// that may cross: it is spelled out, and here, for speed.
inline CrossoverStatus closest_crossover(const Ray& a, const Ray& b, Crossover& crossover) {
  constexpr double kMinSine2 = 1e-10;  // of the angle between the lines
  const auto dot = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    return u.x() * v.x() + u.y() * v.y() + u.z() * v.z();
  };
  const double cosine = dot(a.direction, b.direction);
  const double sine2 = 1.0 - cosine * cosine;
  if (!(sine2 > kMinSine2)) return CrossoverStatus::collinear;
  const Eigen::Vector3d baseline = b.origin - a.origin;
  const double along_a = dot(baseline, a.direction);
  const double along_b = dot(baseline, b.direction);
  const double range_a = (along_a - cosine * along_b) / sine2;
  const double range_b = (cosine * along_a - along_b) / sine2;
  if (!(range_a > 0.0 && range_b > 0.0)) return CrossoverStatus::behind;
  const Eigen::Vector3d on_a = a.origin + range_a * a.direction;
  const Eigen::Vector3d on_b = b.origin + range_b * b.direction;
  const Eigen::Vector3d apart = on_b - on_a;
  crossover.point_m = 0.5 * (on_a + on_b);
  crossover.miss_m = std::sqrt(dot(apart, apart));
  crossover.range_a_m = range_a;
  crossover.range_b_m = range_b;
  return CrossoverStatus::ok;
}

}  // namespace dottrack::geometry
