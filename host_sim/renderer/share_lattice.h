#pragma once
// How much of each lamp is in sight changes slowly over most of a picture: found at every fourth
// pixel of a tile, and between them only where those disagree.

#include <algorithm>
#include <array>
#include <cmath>
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
  using Shares = std::array<double, 4>;  // at the nodes of a cell

  // look(x, y): what the middle of a pixel of the box shows.
  template <class LookAt>
  ShareLattice(const PixelBox& box, std::size_t lamps, const LookAt& look)
      : box_(box),
        lamps_(lamps),
        columns_(nodes_along(box.x1 - box.x0)),
        rows_(nodes_along(box.y1 - box.y0)),
        shares_(columns_ * rows_ * lamps, std::numeric_limits<double>::quiet_NaN()) {
    nodes_.reserve(columns_ * rows_);
    for (std::size_t j = 0; j < rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) nodes_.push_back(look(node_x(i), node_y(j)));
    }
  }

  // stride: of every how many nodes, 1 or 2.
  Cell cell(int x, int y, std::size_t stride = 1) const {
    const std::size_t i = index(x - box_.x0) / stride * stride;
    const std::size_t j = index(y - box_.y0) / stride * stride;
    const std::size_t right = std::min(i + stride, columns_ - 1);
    const std::size_t below = std::min(j + stride, rows_ - 1);
    return {
        {j * columns_ + i, j * columns_ + right, below * columns_ + i, below * columns_ + right},
        fraction(x, node_x(i), node_x(right)),
        fraction(y, node_y(j), node_y(below))};
  }

  // Whether all nodes show what the pixel shows.
  bool same_face_around(const Cell& cell, const Look& face) const {
    return std::all_of(cell.nodes.begin(), cell.nodes.end(),
                       [&](std::size_t node) { return same_face(nodes_[node], face); });
  }

  // What the nodes see of a lamp. find(look, row): the share at a node.
  template <class Find>
  Shares at(const Cell& cell, std::size_t lamp, const Find& find) {
    Shares at{};
    for (std::size_t i = 0; i < at.size(); ++i) {
      double& known = shares_[cell.nodes[i] * lamps_ + lamp];
      if (std::isnan(known)) {
        known = find(nodes_[cell.nodes[i]], node_y(cell.nodes[i] / columns_));
        known_.push_back(&known - shares_.data());
      }
      at[i] = known;
    }
    return at;
  }

  // Nobody has asked yet.
  void forget() {
    for (const std::ptrdiff_t i : known_) {
      shares_[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
    }
    known_.clear();
  }

  // What the pixel sees of it; nothing where the nodes differ by more than the tolerance.
  static std::optional<double> between(const Cell& cell, const Shares& at, double tolerance) {
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
    return std::min(box_.x0 + static_cast<int>(i) * kStep_px, box_.x1 - 1);
  }
  int node_y(std::size_t j) const {
    return std::min(box_.y0 + static_cast<int>(j) * kStep_px, box_.y1 - 1);
  }

  PixelBox box_;
  std::size_t lamps_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<Look> nodes_;
  std::vector<double> shares_;  // by node, then lamp; NaN until somebody asks
  std::vector<std::ptrdiff_t> known_;
};

}  // namespace dottrack::host_sim
