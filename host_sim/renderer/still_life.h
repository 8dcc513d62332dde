#pragma once
// Casts lines of sight of one camera against everything that stands still.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

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

  // Whether some object stands before `distance` on that line; the ground never does.
  bool hides(int x, int y, const Eigen::Vector3d& direction, double distance) const;

 private:
  using Tile = std::vector<std::uint16_t>;  // objects that may be seen in it

  const Tile& tile_of(int x, int y) const;
  Tile fill_tile(int column, int row, const SimCamera& camera, const RayLattice& rays) const;

  Eigen::Vector3d eye_;
  ObjectList objects_;
  int tile_columns_;
  std::vector<Tile> tiles_;
};

}  // namespace dottrack::host_sim
