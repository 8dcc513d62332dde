#pragma once
// Closest crossover of two lines of sight (paper section 3.1.3).

#include <Eigen/Core>
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

// The output is written only when the status is ok.
CrossoverStatus closest_crossover(const Ray& a, const Ray& b, Crossover& crossover);

}  // namespace dottrack::geometry
