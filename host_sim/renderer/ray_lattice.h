#pragma once
// The lines of sight through the corners of all pixels of a camera, computed once.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

class RayLattice {
 public:
  explicit RayLattice(const SimCamera& camera);

  // Through the corner at pixel coordinates (x - 0.5, y - 0.5); 0 <= x <= width, 0 <= y <= height.
  // Zero where the lens sees nothing.
  const Eigen::Vector3d& corner(int x, int y) const {
    return directions_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
  }

  // Inside pixel (x, y): u, v in [0, 1] from its left and upper edge. Bilinear between the corners,
  // which is the lens to 1e-4 px.
  Eigen::Vector3d inside(int x, int y, double u, double v) const {
    return (1.0 - v) * ((1.0 - u) * corner(x, y) + u * corner(x + 1, y)) +
           v * ((1.0 - u) * corner(x, y + 1) + u * corner(x + 1, y + 1));
  }

 private:
  std::size_t columns_;
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace dottrack::host_sim
