#include "host_sim/renderer/ray_lattice.h"

namespace dottrack::host_sim {

RayLattice::RayLattice(const SimCamera& camera)
    : columns_(static_cast<std::size_t>(camera.width_px()) + 1) {
  directions_.reserve(columns_ * (static_cast<std::size_t>(camera.height_px()) + 1));
  for (int y = 0; y <= camera.height_px(); ++y) {
    for (int x = 0; x <= camera.width_px(); ++x) {
      const auto direction = camera.direction({x - 0.5, y - 0.5});
      directions_.push_back(direction.value_or(Eigen::Vector3d::Zero()));
    }
  }
}

}  // namespace dottrack::host_sim
