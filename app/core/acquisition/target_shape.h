#pragma once
// What selection needs to know of the target: the distances between its dots, prepared once.

#include <Eigen/Core>
#include <array>

#include "app/core/rig.h"

namespace dottrack::acquisition {

struct TargetShape {
  std::size_t dots = 0;
  std::array<Eigen::Vector3d, core::kMaxDots> position_m{};  // vehicle coordinates
  std::array<std::array<double, core::kMaxDots>, core::kMaxDots> distance_m{};
  std::array<double, core::kMaxDots> diameter_m{};
  double variance_m2 = 0.0;  // mean squared distance of the dots from their mean
  std::size_t anchor = 0;    // the dot whose neighbours are nearest in the mean square
  bool upright = true;
};

TargetShape make_target_shape(const core::Target& target);

}  // namespace dottrack::acquisition
