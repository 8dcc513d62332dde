#pragma once
// How much of each lamp the small faces of a tile see: those that no lattice resolves share what
// the first of their pixels in a block of 4 x 4 has found.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "host_sim/renderer/patch.h"

namespace dottrack::host_sim {

class FaceShares {
 public:
  explicit FaceShares(std::size_t lamps) : lamps_(lamps) {}

  // To be called before each tile.
  void forget() {
    for (auto& faces : blocks_) faces.clear();
    shares_.clear();
  }

  // The place of a lamp's share for a face in pixel (x, y) of the tile; NaN until it is set. Valid
  // until the next call.
  double& at(int x, int y, const Look& look, std::size_t lamp) {
    constexpr unsigned kBlock_px = 4;
    const unsigned block = (static_cast<unsigned>(y) / kBlock_px % kBlocksAlong) * kBlocksAlong +
                           static_cast<unsigned>(x) / kBlock_px % kBlocksAlong;
    std::vector<Face>& faces = blocks_[block];
    std::size_t i = 0;
    while (i < faces.size() && !same_face(faces[i].look, look)) ++i;
    if (i == faces.size()) {
      faces.push_back({look, shares_.size()});
      shares_.resize(shares_.size() + lamps_, std::numeric_limits<double>::quiet_NaN());
    }
    return shares_[faces[i].first + lamp];
  }

 private:
  static constexpr unsigned kBlocksAlong = 4;  // of a tile of 16 x 16 pixels

  struct Face {
    Look look;
    std::size_t first;  // of its shares
  };

  std::size_t lamps_;
  std::array<std::vector<Face>, std::size_t{kBlocksAlong} * kBlocksAlong> blocks_;
  std::vector<double> shares_;
};

}  // namespace dottrack::host_sim
