#pragma once
// The floor: z = 0 everywhere, sand inside the box and concrete around it. The sand's relief is
// in its shading only, so its geometry stays exact.

#include <Eigen/Core>
#include <cstdint>

#include "host_sim/world/trail.h"

namespace dottrack::host_sim {

struct Ground {
  double half_length_m = 4.0;  // of the sand, along x
  double half_width_m = 3.0;   // along y
  std::uint64_t seed = 1;
  Trail trail;  // empty: nobody has been here

  double albedo_at(const Eigen::Vector2d& p) const;
  Eigen::Vector3d normal_at(const Eigen::Vector2d& p) const;
  bool is_sand(const Eigen::Vector2d& p) const;
};

}  // namespace dottrack::host_sim
