#pragma once
// A picture in tiles of 16 x 16 pixels: which of them a body or its shadow may touch.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "host_sim/renderer/actor.h"
#include "host_sim/renderer/backdrop.h"
#include "host_sim/renderer/ball.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/lamp_light.h"
#include "host_sim/renderer/ray_lattice.h"

namespace dottrack::host_sim {

struct Tile {
  PixelBox box;
  // All lines of sight lie in this cone; they start near its tip.
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit; zero where the lens sees nothing
  double cosine = 1.0;
  double sine = 0.0;
  Ball still;                    // around what stands still there
  std::vector<float> brightest;  // by lamp: the most that it gives to a pixel, at level 1
};

class TileIndex {
 public:
  static constexpr int kTile_px = 16;

  TileIndex(const RayLattice& rays, const Backdrop& backdrop);

  std::span<const Tile> tiles() const { return tiles_; }
  int columns() const { return columns_; }
  int rows() const { return static_cast<int>(tiles_.size()) / columns_; }
  // Where among the tiles.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

 private:
  int columns_;
  std::vector<Tile> tiles_;
};

// Never false where it is in sight, or throws a shadow on what stands still in the tile.
bool may_be_seen(const Actor& body, const Tile& tile);
bool may_shade(const Actor& body, const Tile& tile, const LampLight& lamp);

}  // namespace dottrack::host_sim
