#pragma once
// How much of each lamp is in sight changes slowly over most of a picture: found at every fourth
// pixel of a tile, and between them only where those disagree.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/patch.h"

namespace dottrack::host_sim {

class ShareLattice {
 public:
  // Four nodes around a pixel, and the pixel's place between them.
  struct Cell {
    std::array<std::size_t, 4> nodes{};
    double u = 0.0;
    double v = 0.0;
  };

  // look(x, y): what the middle of a pixel of the tile shows.
  template <class LookAt>
  ShareLattice(const PixelBox& tile, std::size_t lamps, const LookAt& look)
      : tile_(tile),
        lamps_(lamps),
        columns_(nodes_along(tile.x1 - tile.x0)),
        rows_(nodes_along(tile.y1 - tile.y0)),
        shares_(columns_ * rows_ * lamps, std::numeric_limits<double>::quiet_NaN()) {
    nodes_.reserve(columns_ * rows_);
    for (std::size_t j = 0; j < rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) nodes_.push_back(look(node_x(i), node_y(j)));
    }
  }

  // Nothing where a node does not show the same face.
  std::optional<Cell> cell(int x, int y, const Look& face) const {
    const std::size_t i = std::min(index(x - tile_.x0), columns_ - 1);
    const std::size_t j = std::min(index(y - tile_.y0), rows_ - 1);
    const std::size_t right = std::min(i + 1, columns_ - 1);
    const std::size_t below = std::min(j + 1, rows_ - 1);
    const Cell cell{
        {j * columns_ + i, j * columns_ + right, below * columns_ + i, below * columns_ + right},
        fraction(x, node_x(i), node_x(right)),
        fraction(y, node_y(j), node_y(below))};
    for (const std::size_t node : cell.nodes) {
      if (!same_face(nodes_[node], face)) return std::nullopt;
    }
    return cell;
  }

  // The share of a lamp that the pixel sees, between those of the nodes; nothing where they differ
  // by more than the tolerance. find(look, row): the share at a node.
  template <class Find>
  std::optional<double> share(const Cell& cell, std::size_t lamp, double tolerance,
                              const Find& find) {
    std::array<double, 4> at{};
    for (std::size_t i = 0; i < 4; ++i) {
      double& known = shares_[cell.nodes[i] * lamps_ + lamp];
      if (known != known) known = find(nodes_[cell.nodes[i]], node_y(cell.nodes[i] / columns_));
      at[i] = known;
    }
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    if (*high - *low > tolerance) return std::nullopt;
    return (1.0 - cell.v) * ((1.0 - cell.u) * at[0] + cell.u * at[1]) +
           cell.v * ((1.0 - cell.u) * at[2] + cell.u * at[3]);
  }

 private:
  static constexpr int kStep_px = 4;

  static std::size_t index(int pixels) { return static_cast<std::size_t>(pixels / kStep_px); }
  static std::size_t nodes_along(int size_px) { return index(size_px + kStep_px - 2) + 1; }
  static double fraction(int at, int from, int to) {
    return to > from ? static_cast<double>(at - from) / (to - from) : 0.0;
  }
  int node_x(std::size_t i) const {
    return std::min(tile_.x0 + static_cast<int>(i) * kStep_px, tile_.x1 - 1);
  }
  int node_y(std::size_t j) const {
    return std::min(tile_.y0 + static_cast<int>(j) * kStep_px, tile_.y1 - 1);
  }

  PixelBox tile_;
  std::size_t lamps_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<Look> nodes_;
  std::vector<double> shares_;  // by node, then lamp; NaN until somebody asks
};

}  // namespace dottrack::host_sim
