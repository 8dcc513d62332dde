#include "app/core/image/ring_sums.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/ring_sums.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

using Lanes = hn::CappedTag<std::int16_t, 16>;
using Wide = hn::RepartitionToWide<Lanes>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));
static_assert(kMaxPatchSide_px - 1 + kStep <= kPatchColumns_px);  // what a row's end reads

HWY_INLINE Vector all(int value) {
  return hn::Set(kLanes, static_cast<std::int16_t>(value));
}

HWY_INLINE Vector load(const std::uint8_t* pixels) {
  return hn::PromoteTo(kLanes, hn::LoadU(hn::Rebind<std::uint8_t, Lanes>(), pixels));
}

// A sum of products, gathered in 32-bit lanes: a patch's cannot overflow them.
static_assert(std::int64_t{2} * kMaxPatchSide_px * kPatchColumns_px * 255 * 255 <
              (std::int64_t{1} << 31U));
class ProductSum {
 public:
  // Spelled out: a constructor of the compiler's making would be built for another processor.
  HWY_INLINE ProductSum() : even_(hn::Zero(Wide())), odd_(hn::Zero(Wide())) {}

  HWY_INLINE void add(Vector a, Vector b) {
    even_ = hn::ReorderWidenMulAccumulate(Wide(), a, b, even_, odd_);
  }
  HWY_INLINE std::int64_t total() const {
    return hn::GetLane(hn::SumOfLanes(Wide(), hn::Add(even_, odd_)));
  }

 private:
  hn::Vec<Wide> even_;
  hn::Vec<Wide> odd_;
};

// The lanes of columns x that a row's span holds.
HWY_INLINE Vector in_span(Vector x, const Spans& spans, std::size_t row) {
  const auto after_it = hn::Gt(x, hn::Set(kLanes, spans.before[row]));
  const auto before_it = hn::Lt(x, hn::Set(kLanes, spans.after[row]));
  return hn::And(hn::VecFromMask(kLanes, after_it), hn::VecFromMask(kLanes, before_it));
}

HWY_INLINE std::size_t mask_at(std::size_t row, int column) {
  return static_cast<std::size_t>(column) * kPatchRows_px + row * static_cast<std::size_t>(kStep);
}

// A column's values have room in a lane: one strip of columns after the other.
static_assert(kMaxPatchSide_px * 255 < (1 << 15));
void sum_values(const ImageView& patch, const PatchRows& rows, RingMask& mask, PatchSums& sums) {
  ProductSum dot_v, dot_vx, dot_vy, both_v, both_vx, both_vy, ring_vv;
  const Vector one = all(1);
  const auto count = static_cast<std::size_t>(rows.count);
  for (int k = 0; k < patch.width_px; k += kStep) {
    const Vector x = hn::Iota(kLanes, static_cast<std::int16_t>(k));
    Vector row = hn::Zero(kLanes);
    Vector dot_column = row;
    Vector both_column = row;
    const std::uint8_t* pixels = patch.data + k;
    for (std::size_t y = 0; y < count; ++y, pixels += patch.stride_bytes) {
      const Vector inner = in_span(x, rows.inner, y);
      const Vector outer = in_span(x, rows.outer, y);
      const Vector value = load(pixels);
      const Vector both = hn::And(value, outer);
      const Vector dot = hn::And(value, inner);
      const Vector ring = hn::AndNot(inner, both);
      hn::StoreU(hn::AndNot(inner, outer), kLanes, mask.of.data() + mask_at(y, k));
      dot_column = hn::Add(dot_column, dot);
      both_column = hn::Add(both_column, both);
      dot_vy.add(dot, row);
      both_vy.add(both, row);
      ring_vv.add(ring, ring);
      row = hn::Add(row, one);
    }
    dot_v.add(dot_column, one);
    dot_vx.add(dot_column, x);
    both_v.add(both_column, one);
    both_vx.add(both_column, x);
  }
  sums.dot.v = dot_v.total();
  sums.dot.vx = dot_vx.total();
  sums.dot.vy = dot_vy.total();
  sums.ring.v = both_v.total() - sums.dot.v;
  sums.ring.vx = both_vx.total() - sums.dot.vx;
  sums.ring.vy = both_vy.total() - sums.dot.vy;
  sums.ring.vv = ring_vv.total();
}

// Grey levels in the 16 bits of a lane, 64 units each: what no pixel can be still has room.
constexpr int kLaneShift = 10;
using Integers = hn::RepartitionToWide<Lanes>;
using HalfLanes = hn::Rebind<std::int16_t, Integers>;
constexpr std::size_t kHalf = MaxLanes(Integers());

// start + per i for i from 0 on, in those units.
template <std::size_t kSize>
HWY_INLINE void set_line(std::int32_t start, std::int32_t per, int size,
                         std::array<std::int16_t, kSize>& line) {
  const Integers integers;
  static_assert(kSize % kHalf == 0);
  const auto step = hn::Set(integers, per * static_cast<std::int32_t>(kHalf));
  auto at =
      hn::Add(hn::Set(integers, start), hn::Mul(hn::Set(integers, per), hn::Iota(integers, 0)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); i += kHalf) {
    hn::StoreU(hn::DemoteTo(HalfLanes(), hn::ShiftRight<kLaneShift>(at)), HalfLanes(),
               line.data() + i);
    at = hn::Add(at, step);
  }
}

struct Lines {
  std::array<std::int16_t, kPatchColumns_px> across;
  std::array<std::int16_t, kPatchRows_px> down;
};

// All bits of the pixels that are off the plane, row by row of a strip of columns.
class Off {
 public:
  HWY_INLINE Off(const ImageView& patch, const Lines& lines, std::int32_t limit, int column)
      : patch_(patch),
        pixels_(patch.data + column),
        across_(hn::LoadU(kLanes, lines.across.data() + column)),
        down_(lines.down.data()),
        limit_(all(std::min(limit >> kLaneShift, 0x7FFF))) {}

  HWY_INLINE Vector at(std::size_t y) const {
    const std::uint8_t* row = pixels_ + static_cast<std::ptrdiff_t>(y) * patch_.stride_bytes;
    const Vector expected = hn::SaturatedAdd(across_, hn::Set(kLanes, down_[y]));
    const Vector off = hn::Abs(hn::SaturatedSub(hn::ShiftLeft<6>(load(row)), expected));
    return hn::VecFromMask(kLanes, hn::Gt(off, limit_));
  }

 private:
  const ImageView& patch_;
  const std::uint8_t* pixels_;
  Vector across_;
  const std::int16_t* down_;
  Vector limit_;
};

HWY_INLINE Lines lines_of(const IntegerPlane& plane, const ImageView& patch) {
  Lines lines;
  set_line(0, plane.per_x, patch.width_px, lines.across);
  set_line(plane.at_origin, plane.per_y, patch.height_px, lines.down);
  return lines;
}

// Sums over some pixels of a strip: all bits of their lanes are set.
class StripSums {
 public:
  HWY_INLINE StripSums() : count_(hn::Zero(kLanes)), rows_(count_), values_(count_) {}

  HWY_INLINE void add(Vector which, Vector grey, Vector row) {
    const Vector value = hn::And(which, grey);
    const Vector down = hn::And(which, row);
    count_ = hn::Sub(count_, which);
    rows_ = hn::Add(rows_, down);
    values_ = hn::Add(values_, value);
    yy_.add(down, row);
    vy_.add(value, row);
    vv_.add(value, value);
  }

  HWY_INLINE void take_from(GreySums& sums, int column) const {
    const Vector x = hn::Iota(kLanes, static_cast<std::int16_t>(column));
    const Vector one = all(1);
    const Vector across = hn::Mul(count_, x);
    sums.n -= total_of(count_, one);
    sums.x -= total_of(across, one);
    sums.y -= total_of(rows_, one);
    sums.xx -= total_of(across, x);
    sums.xy -= total_of(rows_, x);
    sums.yy -= yy_.total();
    sums.v -= total_of(values_, one);
    sums.vx -= total_of(values_, x);
    sums.vy -= vy_.total();
    sums.vv -= vv_.total();
  }

 private:
  static HWY_INLINE std::int64_t total_of(Vector a, Vector b) {
    ProductSum sum;
    sum.add(a, b);
    return sum.total();
  }

  Vector count_;
  Vector rows_;
  Vector values_;
  ProductSum yy_, vy_, vv_;
};

void drop(const ImageView& patch, const RingMask& mask, const IntegerPlane& plane, GreySums& ring) {
  const Lines lines = lines_of(plane, patch);
  const auto rows = static_cast<std::size_t>(patch.height_px);
  constexpr auto kStripLanes = static_cast<std::size_t>(kStep);
  std::array<std::int16_t, kPatchRows_px * kStripLanes> far;
  for (int k = 0; k < patch.width_px; k += kStep) {
    const Off off(patch, lines, plane.limit, k);
    Vector any = hn::Zero(kLanes);
    for (std::size_t y = 0; y < rows; ++y) {
      const Vector is_far = hn::And(off.at(y), hn::LoadU(kLanes, mask.of.data() + mask_at(y, k)));
      hn::StoreU(is_far, kLanes, far.data() + y * kStripLanes);
      any = hn::Or(any, is_far);
    }
    if (hn::AllFalse(kLanes, hn::MaskFromVec(any))) continue;
    StripSums sums;
    Vector row = hn::Zero(kLanes);
    for (std::size_t y = 0; y < rows; ++y) {
      const Vector is_far = hn::LoadU(kLanes, far.data() + y * kStripLanes);
      sums.add(is_far, load(patch.row(static_cast<int>(y)) + k), row);
      row = hn::Add(row, all(1));
    }
    sums.take_from(ring, k);
  }
}

void find_off(const ImageView& patch, const IntegerPlane& plane, PixelMap& map) {
  const Lines lines = lines_of(plane, patch);
  const auto rows = static_cast<std::size_t>(patch.height_px);
  std::fill_n(map.begin(), rows, 0);
  for (int k = 0; k < std::min(patch.width_px, kMapColumns); k += kStep) {
    const Off off(patch, lines, plane.limit, k);
    for (std::size_t y = 0; y < rows; ++y) {
      map[y] |= bits_of(kLanes, hn::MaskFromVec(off.at(y))) << static_cast<unsigned>(k);
    }
  }
}

constexpr std::array<std::int16_t, 16> kLaneBits{
    1,       1 << 1,  1 << 2,  1 << 3,
    1 << 4,  1 << 5,  1 << 6,  1 << 7,
    1 << 8,  1 << 9,  1 << 10, 1 << 11,
    1 << 12, 1 << 13, 1 << 14, std::numeric_limits<std::int16_t>::min()};

// All bits of the lanes that a map's row holds, from a column on.
HWY_INLINE Vector lanes_of(std::uint64_t row, int column, Vector lane_bits) {
  const auto bits = static_cast<std::int16_t>(row >> static_cast<unsigned>(column) & 0xFFFFU);
  const Vector held = hn::And(hn::Set(kLanes, bits), lane_bits);
  return hn::VecFromMask(kLanes, hn::Eq(held, lane_bits));
}

void take_away(const ImageView& patch, const PixelMap& map, GreySums& from) {
  const Vector lane_bits = hn::LoadU(kLanes, kLaneBits.data());
  const auto rows = static_cast<std::size_t>(patch.height_px);
  std::uint64_t columns = 0;
  for (std::size_t y = 0; y < rows; ++y) columns |= map[y];
  for (int k = 0; k < std::min(patch.width_px, kMapColumns); k += kStep) {
    if ((columns >> static_cast<unsigned>(k) & ((1U << static_cast<unsigned>(kStep)) - 1)) == 0) {
      continue;
    }
    StripSums sums;
    Vector row = hn::Zero(kLanes);
    for (std::size_t y = 0; y < rows; ++y) {
      const Vector grey = load(patch.row(static_cast<int>(y)) + k);
      sums.add(lanes_of(map[y], k, lane_bits), grey, row);
      row = hn::Add(row, all(1));
    }
    sums.take_from(from, k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {
HWY_EXPORT(sum_values);
HWY_EXPORT(drop);
HWY_EXPORT(find_off);
HWY_EXPORT(take_away);

PatchSums sum_patch(const ImageView& patch, const PatchRows& rows, RingMask& mask) {
  PatchSums sums;
  const PlaceSums& inner = rows.inner.places;
  const PlaceSums& outer = rows.outer.places;
  static_cast<PlaceSums&>(sums.dot) = inner;
  static_cast<PlaceSums&>(sums.ring) = {outer.n - inner.n,   outer.x - inner.x,
                                        outer.y - inner.y,   outer.xx - inner.xx,
                                        outer.xy - inner.xy, outer.yy - inner.yy};
  HWY_DYNAMIC_DISPATCH(sum_values)(patch, rows, mask, sums);
  return sums;
}

void drop_outliers(const ImageView& patch, const RingMask& mask, const IntegerPlane& plane,
                   GreySums& ring) {
  HWY_DYNAMIC_DISPATCH(drop)(patch, mask, plane, ring);
}

void find_off_plane(const ImageView& patch, const IntegerPlane& plane, PixelMap& map) {
  HWY_DYNAMIC_DISPATCH(find_off)(patch, plane, map);
}

void subtract(const ImageView& patch, const PixelMap& map, GreySums& sums) {
  HWY_DYNAMIC_DISPATCH(take_away)(patch, map, sums);
}

}  // namespace dottrack::image
#endif
