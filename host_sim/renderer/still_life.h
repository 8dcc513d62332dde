#pragma once
// Casts lines of sight of one camera against everything that stands still.

#include <Eigen/Core>
#include <span>

#include "host_sim/renderer/object_list.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/surface.h"

namespace dottrack::host_sim {

class StillLife {
 public:
  // `objects` must outlive this.
  StillLife(std::span<const Object> objects, const SimCamera& camera, const RayLattice& rays);

  // What the line through pixel (x, y) with this direction meets first.
  SurfaceHit cast(int x, int y, const Eigen::Vector3d& direction) const;

  // Whether something stands before `distance` on that line; the ground never does.
  bool hides(int x, int y, const Eigen::Vector3d& direction, double distance) const {
    return objects_.obstructed(x, y, direction, distance);
  }

 private:
  Eigen::Vector3d eye_;
  ObjectList objects_;
};

}  // namespace dottrack::host_sim
