#include "app/core/acquisition/candidate_grid.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/candidate_grid.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::acquisition {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// No fused operations: every processor must find the same neighbours.
void scan_block(const CandidateGrid::Block& block, std::size_t place, const EdgeTable& table,
                Neighbours& found) {
  const auto [xs, ys, zs] = block.coordinates_m;
  const hn::CappedTag<float, 8> d;
  constexpr std::size_t kLanes = MaxLanes(d);
  const auto x = hn::Set(d, xs[place]);
  const auto y = hn::Set(d, ys[place]);
  const auto z = hn::Set(d, zs[place]);
  const std::span<const EdgeTable::Window> windows = table.windows();
  std::size_t size = 0;
  std::size_t looked = 0;
  DotSet all = 0;
  for (std::size_t row = block.first_row; row <= block.last_row; ++row) {
    const std::uint16_t* const cells = block.first + row * block.columns;
    std::size_t i = cells[block.first_column];
    const std::size_t end = cells[block.last_column + 1];
    looked += end - i;
    // At least once, empty or not: that is predicted best.
    do {
      const auto dx = hn::Sub(hn::LoadU(d, xs + i), x);
      const auto dy = hn::Sub(hn::LoadU(d, ys + i), y);
      const auto dz = hn::Sub(hn::LoadU(d, zs + i), z);
      const auto distance2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      auto beyond = hn::Set(d, 1.0F);  // the nearest window
      for (const EdgeTable::Window& window : windows) {
        const auto off = hn::AbsDiff(distance2, hn::Set(d, window.middle_m2));
        beyond = hn::Min(beyond, hn::Sub(off, hn::Set(d, window.reach_m2)));
      }
      std::uint8_t bytes[8];
      hn::StoreMaskBits(d, hn::Le(beyond, hn::Zero(d)), bytes);
      unsigned lanes = bytes[0] & ((1U << std::min(kLanes, end - i)) - 1U);
      if (lanes != 0) {
        HWY_ALIGN float distances_m2[kLanes];
        hn::Store(distance2, d, distances_m2);
        for (; lanes != 0; lanes &= lanes - 1U) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
          const DotSet dots = table.dots(distances_m2[lane]);
          if (i + lane == place) continue;
          found.list[size++] = {static_cast<std::uint16_t>(i + lane), dots};
          all |= dots;
        }
      }
      i += kLanes;
    } while (i < end);
  }
  found.size = size;
  found.dots = all;
  found.looked = looked;
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {

HWY_EXPORT(scan_block);

namespace {

// Parts of the extent: a float's rounding of a coordinate is less than a tenth of it.
constexpr double kRounding = 1e-6;

// Width of a cell, by how far one looks. Along a row cells may be narrow: they follow each other.
constexpr double kRowReach = 1.0;
constexpr double kColumnReach = 0.25;

}  // namespace

CandidateGrid::Axis::Axis(std::size_t axis, double extent_m, double cell_m, std::size_t most_cells)
    : index(axis) {
  if (!(extent_m > 0.0)) return;  // all in one cell
  const double width_m = std::max(cell_m, extent_m / static_cast<double>(most_cells - 1));
  cells = std::min(static_cast<std::size_t>(extent_m / width_m) + 1, most_cells);
  cells_per_m = static_cast<float>(1.0 / width_m);
}

std::size_t CandidateGrid::Axis::cell(float coordinate_m) const {
  const float cell = coordinate_m * cells_per_m;
  return cell > 0.0F ? static_cast<std::size_t>(std::min(cell, static_cast<float>(cells - 1))) : 0;
}

void CandidateGrid::build(std::span<const DotCandidate> candidates, double least_diameter_m,
                          double most_diameter_m, double reach_m) {
  size_ = 0;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Eigen::Vector3d least = Eigen::Vector3d::Constant(kFar);
  Eigen::Vector3d most = -least;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const DotCandidate& candidate = candidates[c];
    if (!(candidate.diameter_m >= least_diameter_m && candidate.diameter_m <= most_diameter_m) ||
        !candidate.position_m.allFinite()) {
      continue;
    }
    least = least.cwiseMin(candidate.position_m);
    most = most.cwiseMax(candidate.position_m);
    taken_[size_++] = static_cast<std::uint16_t>(c);
  }
  if (size_ == 0) return;
  const Eigen::Vector3d extent = most - least;
  const std::array<double, 3> extent_m{extent.x(), extent.y(), extent.z()};
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(),
            [&](std::size_t a, std::size_t b) { return extent_m[a] > extent_m[b]; });
  origin_m_ = least;
  rounding_m_ = kRounding * extent.maxCoeff();
  row_ = Axis(axes[0], extent_m[axes[0]], kRowReach * reach_m, kMaxRows);
  column_ = Axis(axes[1], extent_m[axes[1]], kColumnReach * reach_m, kMaxColumns);
  sort_in(candidates);
}

std::array<float, 3> CandidateGrid::from_origin(const Eigen::Vector3d& position_m) const {
  const Eigen::Vector3f p = (position_m - origin_m_).cast<float>();
  return {p.x(), p.y(), p.z()};
}

// A counting sort by cells.
void CandidateGrid::sort_in(std::span<const DotCandidate> candidates) {
  const std::size_t cells = row_.cells * column_.cells;
  std::fill_n(first_.begin(), cells + 1, std::uint16_t{0});
  for (std::size_t i = 0; i < size_; ++i) {
    const std::array<float, 3> p = from_origin(candidates[taken_[i]].position_m);
    const std::size_t cell =
        row_.cell(p[row_.index]) * column_.cells + column_.cell(p[column_.index]);
    cell_of_[i] = static_cast<std::uint16_t>(cell);
    ++first_[cell];
  }
  std::uint16_t end = 0;
  for (std::size_t cell = 0; cell <= cells; ++cell) first_[cell] = end += first_[cell];
  for (std::size_t i = size_; i-- > 0;) {
    const std::size_t place = --first_[cell_of_[i]];
    const std::array<float, 3> p = from_origin(candidates[taken_[i]].position_m);
    candidate_[place] = taken_[i];
    for (std::size_t axis = 0; axis < 3; ++axis) coordinates_m_[axis][place] = p[axis];
  }
}

void CandidateGrid::neighbours(std::size_t place, const EdgeTable& table, Neighbours& found) const {
  const float reach_m = table.reach_m() + static_cast<float>(rounding_m_);
  const float at_row_m = coordinates_m_[row_.index][place];
  const float at_column_m = coordinates_m_[column_.index][place];
  const Block block{
      .coordinates_m = {coordinates_m_[0].data(), coordinates_m_[1].data(),
                        coordinates_m_[2].data()},
      .first = first_.data(),
      .columns = column_.cells,
      .first_row = row_.cell(at_row_m - reach_m),
      .last_row = row_.cell(at_row_m + reach_m),
      .first_column = column_.cell(at_column_m - reach_m),
      .last_column = column_.cell(at_column_m + reach_m),
  };
  HWY_DYNAMIC_DISPATCH(scan_block)(block, place, table, found);
}

}  // namespace dottrack::acquisition
#endif
