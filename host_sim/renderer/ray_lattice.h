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
  // Direction zero where the lens sees nothing.
  Sight corner(int x, int y) const {
    const std::size_t i = index(x, y);
    return {origins_.empty() ? centre_m_ : origins_[i], directions_[i]};
  }

  // Whether the lens sees all of pixel (x, y).
  bool seen(int x, int y) const {
    const std::size_t i = index(x, y);
    for (const std::size_t at : {i, i + 1, i + columns_, i + columns_ + 1}) {
      if (directions_[at].isZero(0.0)) return false;
    }
    return true;
  }

  // Inside pixel (x, y), which the lens sees: u, v in [0, 1] from its left and upper edge.
  // Bilinear between the corners: the lens to 0.0005 px where it has 640 pixels in 80 degrees or
  // more, to 0.002 px in the corners of strongly bent fish-eyes.
  Sight inside(int x, int y, double u, double v) const {
    const std::size_t i = index(x, y);
    return {origins_.empty() ? centre_m_ : between(origins_, i, u, v),
            between(directions_, i, u, v)};
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
  }
  Eigen::Vector3d between(const std::vector<Eigen::Vector3d>& corners, std::size_t i, double u,
                          double v) const {
    return (1.0 - v) * ((1.0 - u) * corners[i] + u * corners[i + 1]) +
           v * ((1.0 - u) * corners[i + columns_] + u * corners[i + columns_ + 1]);
  }

  std::size_t columns_;
  Eigen::Vector3d centre_m_;
  std::vector<Eigen::Vector3d> directions_;
  std::vector<Eigen::Vector3d> origins_;  // of a lens whose pupil moves; else empty
};

}  // namespace dottrack::host_sim
