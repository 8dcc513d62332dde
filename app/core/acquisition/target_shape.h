#pragma once
// What selection needs to know of the target: the distances between its dots, prepared once.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "app/core/rig.h"

namespace dottrack::acquisition {

struct TargetShape {
  std::size_t dots = 0;
  std::array<Eigen::Vector3d, core::kMaxDots> position_m{};  // vehicle coordinates
  std::array<std::array<double, core::kMaxDots>, core::kMaxDots> distance_m{};
  std::array<double, core::kMaxDots> diameter_m{};
  // The dots as a search takes them for its anchor: each the one, of those that are left, whose
  // neighbours among them are nearest in the mean square.
  std::array<std::uint8_t, core::kMaxDots> anchors{};
  bool upright = true;
};

TargetShape make_target_shape(const core::Target& target);

}  // namespace dottrack::acquisition
