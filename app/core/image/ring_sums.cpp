#include "app/core/image/ring_sums.h"

#include <algorithm>
#include <bit>
#include <cstddef>

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

// The lanes of columns x that the span holds.
HWY_INLINE hn::Mask<Lanes> in_span(Vector x, Span span) {
  return hn::And(hn::Gt(x, all(span.first - 1)), hn::Lt(x, all(span.last + 1)));
}

void sum_values(const ImageView& patch, const PatchRows& rows, PatchSums& sums) {
  ProductSum dot_v, dot_vx, dot_vy, ring_v, ring_vx, ring_vy, ring_vv;
  const Vector iota = hn::Iota(kLanes, 0);
  const Vector one = all(1);
  for (int y = 0; y < rows.count; ++y) {
    const Span outer = rows.outer[static_cast<std::size_t>(y)];
    const Span inner = rows.inner[static_cast<std::size_t>(y)];
    const std::uint8_t* pixels = patch.row(y);
    const Vector row = all(y);
    for (int k = outer.first; k <= outer.last; k += kStep) {
      const Vector x = hn::Add(iota, all(k));
      const Vector value = hn::IfThenElseZero(in_span(x, outer), load(pixels + k));
      const auto inside = in_span(x, inner);
      const Vector dot = hn::IfThenElseZero(inside, value);
      const Vector ring = hn::IfThenZeroElse(inside, value);
      dot_v.add(dot, one);
      dot_vx.add(dot, x);
      dot_vy.add(dot, row);
      ring_v.add(ring, one);
      ring_vx.add(ring, x);
      ring_vy.add(ring, row);
      ring_vv.add(ring, ring);
    }
  }
  sums.dot.v = dot_v.total();
  sums.dot.vx = dot_vx.total();
  sums.dot.vy = dot_vy.total();
  sums.ring.v = ring_v.total();
  sums.ring.vx = ring_vx.total();
  sums.ring.vy = ring_vy.total();
  sums.ring.vv = ring_vv.total();
}

// Grey levels in the 16 bits of a lane, 64 units each: what no pixel can be still has room.
constexpr std::int64_t kUnitsPerLaneUnit = 65536 / 64;

HWY_INLINE std::int16_t lane_units(std::int64_t units) {
  return static_cast<std::int16_t>(
      std::clamp<std::int64_t>(units / kUnitsPerLaneUnit, -0x7FFF, 0x7FFF));
}

void drop(const ImageView& patch, const PatchRows& rows, const IntegerPlane& plane,
          GreySums& ring) {
  std::array<std::int16_t, kPatchColumns_px> across{};
  for (std::size_t x = 0; x < static_cast<std::size_t>(patch.width_px); ++x) {
    across[x] = lane_units(plane.per_x * static_cast<std::int64_t>(x));
  }
  const Vector iota = hn::Iota(kLanes, 0);
  const Vector limit = all(lane_units(plane.limit));
  for (int y = 0; y < rows.count; ++y) {
    const Span outer = rows.outer[static_cast<std::size_t>(y)];
    const Span inner = rows.inner[static_cast<std::size_t>(y)];
    const std::uint8_t* pixels = patch.row(y);
    const Vector down = all(lane_units(plane.at_origin + plane.per_y * y));
    for (int k = outer.first; k <= outer.last; k += kStep) {
      const Vector x = hn::Add(iota, all(k));
      const Vector expected = hn::SaturatedAdd(down, hn::LoadU(kLanes, across.data() + k));
      const Vector value = hn::ShiftLeft<6>(load(pixels + k));
      const Vector off =
          hn::Max(hn::SaturatedSub(value, expected), hn::SaturatedSub(expected, value));
      const auto outside = hn::AndNot(in_span(x, inner), in_span(x, outer));
      const auto far = hn::And(outside, hn::Gt(off, limit));
      if (hn::AllFalse(kLanes, far)) [[likely]] {
        continue;
      }
      for (std::uint64_t bits = bits_of(kLanes, far); bits != 0; bits &= bits - 1) {
        const int column = k + std::countr_zero(bits);
        subtract(ring, column, y, pixels[column]);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {
namespace {

// Sums of 1, x, y and their products over rows of pixels. With n columns from first to last and m =
// first + last: 2 sum x = n m, 12 sum x^2 = 3 n m^2 + n^3 - n.
class PlaceSums {
 public:
  void add(Span span, int y) {
    const int n = span.last - span.first + 1;
    const int m = span.last + span.first;
    n_ += n;
    x2_ += n * m;
    xx12_ += n * (3 * m * m + n * n - 1);
    y_ += n * y;
    yy_ += n * y * y;
    xy2_ += n * m * y;
  }

  // Adds them, or takes them away.
  void move_to(GreySums& sums, int sign) const {
    sums.n += sign * n_;
    sums.x += sign * (x2_ / 2);
    sums.y += sign * y_;
    sums.xx += sign * (xx12_ / 12);
    sums.xy += sign * (xy2_ / 2);
    sums.yy += sign * yy_;
  }

 private:
  int n_ = 0;
  int x2_ = 0;
  int xx12_ = 0;
  int y_ = 0;
  int yy_ = 0;
  int xy2_ = 0;
};

}  // namespace

HWY_EXPORT(sum_values);
HWY_EXPORT(drop);

PatchSums sum_patch(const ImageView& patch, const PatchRows& rows) {
  PlaceSums outer;
  PlaceSums inner;
  for (int y = 0; y < rows.count; ++y) {
    outer.add(rows.outer[static_cast<std::size_t>(y)], y);
    inner.add(rows.inner[static_cast<std::size_t>(y)], y);
  }
  PatchSums sums;
  inner.move_to(sums.dot, 1);
  outer.move_to(sums.ring, 1);
  inner.move_to(sums.ring, -1);
  HWY_DYNAMIC_DISPATCH(sum_values)(patch, rows, sums);
  return sums;
}

void drop_outliers(const ImageView& patch, const PatchRows& rows, const IntegerPlane& plane,
                   GreySums& ring) {
  HWY_DYNAMIC_DISPATCH(drop)(patch, rows, plane, ring);
}

}  // namespace dottrack::image
#endif
