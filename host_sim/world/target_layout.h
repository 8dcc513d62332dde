#pragma once
// Where the dots sit on the vehicle.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace dottrack::host_sim {

struct TargetDot {
  Eigen::Vector3d centre_m;  // vehicle coordinates
  double diameter_m;
  Eigen::Vector3d normal;  // unit, vehicle coordinates
};

using TargetLayout = std::vector<TargetDot>;

// How unlike itself a layout is under any relabelling of its dots, metres: no two dots have all
// their distances to the others equal within this, in any order. At 0 it may be symmetrical.
double distinctness_m(const TargetLayout& layout);

// Five dots spread over the deck, all distances different.
TargetLayout demo_layout();

// n dots (3 to 16) at random places of the deck with room between them, distinct by 3 cm or more.
TargetLayout random_layout(int dots, std::uint64_t seed);

}  // namespace dottrack::host_sim
