#include "app/core/acquisition/point_grid.h"

namespace dottrack::acquisition {

void PointGrid::clear(double search_radius_m) {
  heads_.fill(kNone);
  cells_per_m_ = 0.5 / search_radius_m;
}

std::size_t PointGrid::head_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto mix = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                   static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                   static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL;
  return static_cast<std::size_t>((mix ^ (mix >> 29)) & (kHeads - 1));
}

std::size_t PointGrid::head_at(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d cell = in_cells(point_m).array().floor();
  return head_of(static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                 static_cast<std::int64_t>(cell.z()));
}

void PointGrid::insert(std::uint16_t index, const Eigen::Vector3d& point_m) {
  std::uint16_t& head = heads_[head_at(point_m)];
  next_[index] = head;
  head = index;
}

void PointGrid::move(std::uint16_t index, const Eigen::Vector3d& from_m,
                     const Eigen::Vector3d& to_m) {
  const std::size_t old_head = head_at(from_m);
  if (old_head == head_at(to_m)) return;
  std::uint16_t* link = &heads_[old_head];
  while (*link != index) link = &next_[*link];
  *link = next_[index];
  insert(index, to_m);
}

}  // namespace dottrack::acquisition
