#include "app/core/image/gates.h"

#include <cmath>
#include <numbers>

namespace dottrack::image {

namespace {

// Beyond what any image has.
constexpr double kMost = 1e12;

std::int64_t whole(double value) {
  return static_cast<std::int64_t>(std::floor(std::clamp(value, -kMost, kMost)));
}

}  // namespace

SizeBounds::SizeBounds(const RegionGate& gate) : min_area_px_(gate.min_area_px) {
  // Of all shapes of some area the disc has the least major axis.
  const double max_squared = gate.semi_major_max_px * gate.semi_major_max_px;
  const double max_area = std::min(std::numbers::pi * max_squared, kMost);
  max_area_px_ = whole(max_area);
  // A connected region has a pixel in each of its w columns: sum (x - mean)^2 >= w (w^2 - 1) / 12.
  // So w (w^2 - 1) <= area (3 max^2 - 1), and (w - 1)^3 is less.
  max_extent_px_ = whole(std::cbrt(max_area * std::min(3.0 * max_squared, kMost)));
  // A variance is at most a quarter of the extent squared.
  min_diagonal_squared_ = whole(gate.semi_major_min_px * gate.semi_major_min_px - 1.0 / 3.0);
}

}  // namespace dottrack::image
