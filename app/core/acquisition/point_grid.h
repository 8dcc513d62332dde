#pragma once
// A hash grid of points in space: which of them are near a place, in constant time.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/limits.h"

namespace dottrack::acquisition {

// Holds up to kMaxFinalists points by index. No allocation.
class PointGrid {
 public:
  void clear(double search_radius_m);
  void insert(std::uint16_t index, const Eigen::Vector3d& point_m);
  void move(std::uint16_t index, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m);

  // Calls visit(index) for every point within the search radius, and some beyond it.
  template <class Visit>
  void visit_near(const Eigen::Vector3d& point_m, const Visit& visit) const;

 private:
  static constexpr std::size_t kHeads = 16384;  // a power of two
  static constexpr std::uint16_t kNone = 0xFFFF;

  // Cells are twice the radius wide, so the ball around a point touches at most eight.
  Eigen::Vector3d in_cells(const Eigen::Vector3d& point_m) const { return point_m * cells_per_m_; }
  static std::size_t head_of(std::int64_t x, std::int64_t y, std::int64_t z);
  std::size_t head_at(const Eigen::Vector3d& point_m) const;

  std::array<std::uint16_t, kHeads> heads_{};
  std::array<std::uint16_t, core::kMaxFinalists> next_{};
  double cells_per_m_ = 1.0;
};

template <class Visit>
void PointGrid::visit_near(const Eigen::Vector3d& point_m, const Visit& visit) const {
  const Eigen::Vector3d corner = in_cells(point_m) - Eigen::Vector3d::Constant(0.5);
  const Eigen::Matrix<std::int64_t, 3, 1> low =
      corner.array().floor().matrix().cast<std::int64_t>();
  std::array<std::size_t, 8> seen;
  std::size_t heads = 0;
  for (int i = 0; i < 8; ++i) {
    const std::size_t head =
        head_of(low.x() + (i & 1), low.y() + ((i >> 1) & 1), low.z() + (i >> 2));
    bool repeated = false;  // two of the eight cells may share a chain
    for (std::size_t k = 0; k < heads; ++k) repeated = repeated || seen[k] == head;
    if (repeated) continue;
    seen[heads++] = head;
    for (std::uint16_t index = heads_[head]; index != kNone; index = next_[index]) visit(index);
  }
}

}  // namespace dottrack::acquisition
