#include "app/core/image/uneven_ring.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "app/core/image/ring_level.h"

namespace dottrack::image {
namespace {

constexpr int kRounds = 3;

using Row = PixelMap::value_type;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

Row up_to(int end) {
  return end >= kMapColumns ? ~Row{0} : (Row{1} << static_cast<unsigned>(std::max(end, 0))) - 1;
}
Row bits_of(const Spans& spans, int y) {
  return up_to(spans.after[index(y)]) & ~up_to(spans.before[index(y)] + 1);
}

// The eight next to each.
PixelMap neighbours(const PixelMap& map, int rows) {
  const auto sides = [](Row row) { return (row << 1U) | (row >> 1U); };
  PixelMap next;
  Row above = 0;
  for (int y = 0; y < rows; ++y) {
    const Row here = map[index(y)];
    const Row below = y + 1 < rows ? map[index(y + 1)] : 0;
    next[index(y)] = sides(above | here | below) | above | below;
    above = here;
  }
  return next;
}

// Those off the plane where the dot's light does not reach. One by itself may be noise; what is
// left is blurred into the pixels next to it.
PixelMap strangers_in(const ImageView& patch, const PatchRows& rows, const Spans& lit,
                      const IntegerPlane& plane) {
  PixelMap map;
  find_off_plane(patch, plane, map);
  for (int y = 0; y < rows.count; ++y) map[index(y)] &= bits_of(rows.outer, y) & ~bits_of(lit, y);
  const PixelMap next = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] &= next[y];
  const PixelMap wide = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] |= wide[y];
  return map;
}

}  // namespace

void find_own_ground(const ImageView& patch, const PatchRows& nearest, const RingMask& mask,
                     const GreySums& whole, Plane& plane) {
  RingLevel level;
  if (!find_level(patch, nearest, level)) return;
  Plane ground{level.middle_dn, 0.0, 0.0, level.sigma_dn};
  std::int64_t kept_before = 0;
  for (int round = 0; round < kRounds; ++round) {
    GreySums kept = whole;
    drop_outliers(patch, mask, rounded(ground, noise_limit_dn(ground)), kept);
    if (!fit(kept, ground)) return;
    ground.sigma = std::min(ground.sigma, level.sigma_dn);
    if (kept.n == kept_before) break;
    kept_before = kept.n;
  }
  plane = ground;
}

void drop_strangers(const ImageView& patch, const PatchRows& rows, const DotReach& reach,
                    const Plane& plane, PatchSums& sums, DotPixels& pixels) {
  Plane middle = plane;  // of what noise and the dot's light make of the ground
  middle.at_origin += 0.5 * reach.tail_dn;
  const double limit_dn = noise_limit_dn(plane) + 0.5 * std::abs(reach.tail_dn);
  const PixelMap strangers = strangers_in(patch, rows, reach.lit, rounded(middle, limit_dn));
  PixelMap of_dot;
  PixelMap of_ring;
  PixelMap others;
  Row any_inside = 0;
  for (int y = 0; y < rows.count; ++y) {
    const Row row = strangers[index(y)] & bits_of(rows.outer, y) & ~bits_of(reach.edge, y);
    const Row inside = bits_of(rows.inner, y);
    of_dot[index(y)] = row & inside;
    of_ring[index(y)] = row & ~inside;
    others[index(y)] = inside & ~row;
    any_inside |= row & inside;
  }
  subtract(patch, of_ring, sums.ring);
  if (any_inside == 0) return;
  subtract(patch, of_dot, sums.dot);
  list_pixels(patch, others, pixels);
}

}  // namespace dottrack::image
