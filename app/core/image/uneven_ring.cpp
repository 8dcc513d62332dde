#include "app/core/image/uneven_ring.h"

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>

#include "app/core/image/ring_level.h"

namespace dottrack::image {
namespace {

constexpr int kRounds = 3;

using Row = std::bitset<kPatchColumns_px>;
using Map = std::array<Row, kPatchRows_px>;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

// Pixels further off the plane than a limit, where the dot's light does not reach.
Map off_plane(const ImageView& patch, const PatchRows& rows, const Spans& lit, const Plane& plane,
              double limit_dn) {
  Map map;
  for (int y = 0; y < rows.count; ++y) {
    for (int x = rows.outer.before[index(y)] + 1; x < rows.outer.after[index(y)]; ++x) {
      const double off_dn = patch.at(x, y) - plane.at_origin - plane.per_x * x - plane.per_y * y;
      map[index(y)][index(x)] = std::abs(off_dn) > limit_dn && !lit.holds(x, y);
    }
  }
  return map;
}

// The eight next to each.
Map neighbours(const Map& map, int rows) {
  Map next;
  for (int y = 0; y < rows; ++y) {
    const auto sides = [&](int at) { return (map[index(at)] << 1U) | (map[index(at)] >> 1U); };
    next[index(y)] = sides(y);
    if (y > 0) next[index(y)] |= sides(y - 1) | map[index(y - 1)];
    if (y + 1 < rows) next[index(y)] |= sides(y + 1) | map[index(y + 1)];
  }
  return next;
}

// One by itself may be noise. What is left is blurred into the pixels next to it.
Map strangers_in(const ImageView& patch, const PatchRows& rows, const Spans& lit,
                 const Plane& plane) {
  Map map = off_plane(patch, rows, lit, plane, noise_limit_dn(plane));
  const Map next = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] &= next[y];
  const Map wide = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] |= wide[y];
  return map;
}

}  // namespace

void find_own_ground(const ImageView& patch, const PatchRows& nearest, const RingMask& mask,
                     const GreySums& whole, Plane& plane) {
  RingLevel level;
  if (!find_level(patch, nearest, level)) return;
  Plane ground{level.middle_dn, 0.0, 0.0, level.sigma_dn};
  for (int round = 0; round < kRounds; ++round) {
    GreySums kept = whole;
    drop_outliers(patch, mask, rounded(ground, noise_limit_dn(ground)), kept);
    if (!fit(kept, ground)) return;
  }
  plane = ground;
}

void drop_strangers(const ImageView& patch, const PatchRows& rows, const DotReach& reach,
                    const Plane& plane, PatchSums& sums, DotPixels& pixels) {
  const Map strangers = strangers_in(patch, rows, reach.lit, plane);
  pixels.count = 0;
  for (int y = 0; y < rows.count; ++y) {
    for (int x = rows.outer.before[index(y)] + 1; x < rows.outer.after[index(y)]; ++x) {
      const bool inside = rows.inner.holds(x, y);
      if (strangers[index(y)][index(x)] && !reach.edge.holds(x, y)) {
        subtract(inside ? sums.dot : sums.ring, x, y, patch.at(x, y));
      } else if (inside) {
        pixels.add(x, y, patch.at(x, y));
      }
    }
  }
  pixels.close();
}

}  // namespace dottrack::image
