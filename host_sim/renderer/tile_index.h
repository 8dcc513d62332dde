#pragma once
// Which objects may be seen in which part of the picture.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/world/shapes.h"

namespace dottrack::host_sim {

class TileIndex {
 public:
  static constexpr int kTile_px = 16;

  // Sorts balls, seen from `eye`, into the tiles of `box`. corner(x, y): the line of sight through
  // the upper left corner of pixel (x, y), in the same coordinates.
  TileIndex(std::span<const Ball> balls, const Eigen::Vector3d& eye, const PixelBox& box,
            const std::function<Eigen::Vector3d(int, int)>& corner);

  // For a pixel of the box: a superset of the balls that lines of sight through it meet.
  std::span<const std::uint16_t> at(int x, int y) const {
    const int tile = (y - box_.y0) / kTile_px * columns_ + (x - box_.x0) / kTile_px;
    return tiles_[static_cast<std::size_t>(tile)];
  }

 private:
  PixelBox box_;
  int columns_;
  std::vector<std::vector<std::uint16_t>> tiles_;
};

}  // namespace dottrack::host_sim
