#include "host_sim/renderer/ray_lattice.h"

namespace dottrack::host_sim {

RayLattice::RayLattice(const SimCamera& camera)
    : columns_(static_cast<std::size_t>(camera.width_px()) + 1), centre_m_(camera.centre_m()) {
  const std::size_t corners = columns_ * (static_cast<std::size_t>(camera.height_px()) + 1);
  const bool moves = camera.lens().kind == LensKind::fisheye;
  directions_.reserve(corners);
  if (moves) origins_.reserve(corners);
  for (int y = 0; y <= camera.height_px(); ++y) {
    for (int x = 0; x <= camera.width_px(); ++x) {
      const auto sight = camera.sight({x - 0.5, y - 0.5});
      directions_.push_back(sight ? sight->direction : Eigen::Vector3d::Zero());
      if (moves) origins_.push_back(sight ? sight->origin : centre_m_);
    }
  }
}

}  // namespace dottrack::host_sim
