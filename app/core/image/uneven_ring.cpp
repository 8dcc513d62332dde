#include "app/core/image/uneven_ring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "app/core/image/ring_level.h"

namespace dottrack::image {
namespace {

constexpr int kRounds = 3;

// A bit a column. The widest patch has one more: its last column is nobody's.
using Row = std::uint64_t;
using Map = std::array<Row, kPatchRows_px>;
constexpr int kColumns = 64;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

Row up_to(int end) {
  return end >= kColumns ? ~Row{0} : (Row{1} << static_cast<unsigned>(std::max(end, 0))) - 1;
}
Row bits_of(const Spans& spans, int y) {
  return up_to(spans.after[index(y)]) & ~up_to(spans.before[index(y)] + 1);
}

// Of the row's columns from first on, those that are off the plane by more than its limit.
Row off_plane(const std::uint8_t* pixels, int y, int first, int end, const IntegerPlane& plane) {
  constexpr int kUnits = 65536;  // of the plane, a grey level
  std::int32_t expected = plane.at_origin + plane.per_y * y + plane.per_x * first;
  Row row = 0;
  for (int x = first; x < end; ++x) {
    const bool far = std::abs(kUnits * pixels[x] - expected) > plane.limit;
    row |= Row{far} << static_cast<unsigned>(x);
    expected += plane.per_x;
  }
  return row;
}

// Pixels off the plane where the dot's light does not reach.
Map off_plane(const ImageView& patch, const PatchRows& rows, const Spans& lit,
              const IntegerPlane& plane) {
  Map map;
  for (int y = 0; y < rows.count; ++y) {
    const int first = rows.outer.before[index(y)] + 1;
    const int end = std::min<int>(rows.outer.after[index(y)], kColumns);
    const int lit_first = std::clamp<int>(lit.before[index(y)] + 1, first, std::max(first, end));
    const int lit_end = std::clamp<int>(lit.after[index(y)], lit_first, std::max(lit_first, end));
    map[index(y)] = off_plane(patch.row(y), y, first, lit_first, plane) |
                    off_plane(patch.row(y), y, lit_end, end, plane);
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
                 const IntegerPlane& plane) {
  Map map = off_plane(patch, rows, lit, plane);
  const Map next = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] &= next[y];
  const Map wide = neighbours(map, rows.count);
  for (std::size_t y = 0; y < index(rows.count); ++y) map[y] |= wide[y];
  return map;
}

void subtract_row(const std::uint8_t* pixels, int y, Row row, GreySums& sums) {
  for (; row != 0; row &= row - 1) {
    const int x = std::countr_zero(row);
    subtract(sums, x, y, pixels[x]);
  }
}

void list_others(const ImageView& patch, const PatchRows& rows, const Map& strangers,
                 DotPixels& pixels) {
  pixels.count = 0;
  for (int y = 0; y < rows.count; ++y) {
    const std::uint8_t* row = patch.row(y);
    for (int x = rows.inner.before[index(y)] + 1; x < rows.inner.after[index(y)]; ++x) {
      const bool stranger =
          x < kColumns && ((strangers[index(y)] >> static_cast<unsigned>(x)) & 1U) != 0;
      if (!stranger) pixels.add(x, y, row[x]);
    }
  }
  pixels.close();
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
    if (kept.n == kept_before) break;
    kept_before = kept.n;
  }
  plane = ground;
}

void drop_strangers(const ImageView& patch, const PatchRows& rows, const DotReach& reach,
                    const Plane& plane, PatchSums& sums, DotPixels& pixels) {
  const double limit_dn = noise_limit_dn(plane) + reach.tail_dn;
  Map strangers = strangers_in(patch, rows, reach.lit, rounded(plane, limit_dn));
  Row any_inside = 0;
  for (int y = 0; y < rows.count; ++y) {
    Row& row = strangers[index(y)];
    row &= bits_of(rows.outer, y) & ~bits_of(reach.edge, y);
    const Row inside = bits_of(rows.inner, y);
    any_inside |= row & inside;
    subtract_row(patch.row(y), y, row & inside, sums.dot);
    subtract_row(patch.row(y), y, row & ~inside, sums.ring);
  }
  if (any_inside != 0) list_others(patch, rows, strangers, pixels);
}

}  // namespace dottrack::image
