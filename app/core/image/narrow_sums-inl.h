// Sums over the pixels of a small component, its columns in the lanes of one vector or two.
// Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_NARROW_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_NARROW_SUMS_INL_H_
#undef DOTTRACK_IMAGE_NARROW_SUMS_INL_H_
#else
#define DOTTRACK_IMAGE_NARROW_SUMS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "app/core/image/region_sums.h"

#if HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace narrow {
namespace hn = hwy::HWY_NAMESPACE;

using Columns = hn::FixedTag<std::int16_t, 8>;
using Quads = hn::FixedTag<std::int32_t, 4>;
using Vector = hn::Vec<Columns>;
constexpr Columns kColumns;
constexpr Quads kQuads;
constexpr int kVectorColumns = 8;
// No lane exceeds 15 bits: the most is sum of y * 255 with each row once, 30600.
constexpr int kMaxRows = 16;

constexpr std::array<std::int16_t, 48> ones_from_the_middle() {
  std::array<std::int16_t, 48> table{};
  for (std::size_t i = 24; i < table.size(); ++i) table[i] = -1;
  return table;
}
constexpr std::array<std::int16_t, 48> kStep = ones_from_the_middle();

// All bits set in the lanes first <= column + lane <= last; from -8 to 23 each.
HWY_INLINE Vector lanes_between(int column, int first, int last) {
  return hn::AndNot(hn::LoadU(kColumns, kStep.data() + 24 + column - (last + 1)),
                    hn::LoadU(kColumns, kStep.data() + 24 + column - first));
}

// What is gathered of eight columns, each in a lane.
class ColumnSums {
 public:
  // Spelled out: a constructor of the compiler's making would be built for another processor.
  HWY_INLINE ColumnSums()
      : n_(hn::Zero(kColumns)), y_(n_), yy_(n_), v_(n_), vy_(n_), saturated_(n_), faintest_(n_) {}

  // `inside` has all bits set in the lanes that are pixels of the component.
  HWY_INLINE void add(int row, Vector inside, Vector pixel, Vector value, Vector flip) {
    const auto y = hn::Set(kColumns, static_cast<std::int16_t>(row));
    value = hn::And(value, inside);
    n_ = hn::Sub(n_, inside);
    y_ = hn::Add(y_, hn::And(y, inside));
    yy_ = hn::Add(yy_, hn::And(hn::Mul(y, y), inside));
    v_ = hn::Add(v_, value);
    vy_ = hn::Add(vy_, hn::Mul(value, y));
    const auto full = hn::VecFromMask(kColumns, hn::Eq(pixel, hn::Set(kColumns, 255)));
    saturated_ = hn::Sub(saturated_, hn::And(full, inside));
    faintest_ = hn::Max(faintest_, hn::And(hn::Xor(pixel, flip), inside));
  }

  Vector n_, y_, yy_, v_, vy_, saturated_, faintest_;
};

HWY_INLINE hn::Vec<Quads> products(Vector a, Vector b, hn::Vec<Quads> sum) {
  auto odd = hn::Zero(kQuads);
  sum = hn::ReorderWidenMulAccumulate(kQuads, a, b, sum, odd);
  return hn::Add(sum, odd);
}

// The four totals, a lane each.
HWY_INLINE hn::Vec<Quads> totals(hn::Vec<Quads> a, hn::Vec<Quads> b, hn::Vec<Quads> c,
                                 hn::Vec<Quads> d) {
  const auto ab = hn::Add(hn::InterleaveLower(kQuads, a, b), hn::InterleaveUpper(kQuads, a, b));
  const auto cd = hn::Add(hn::InterleaveLower(kQuads, c, d), hn::InterleaveUpper(kQuads, c, d));
  return hn::Add(hn::ConcatLowerLower(kQuads, cd, ab), hn::ConcatUpperUpper(kQuads, cd, ab));
}

HWY_INLINE void store(hn::Vec<Quads> v, double* to) {
  const hn::FixedTag<double, 2> pair;
  const hn::Half<Quads> half;
  hn::StoreU(hn::PromoteTo(pair, hn::LowerHalf(half, v)), pair, to);
  hn::StoreU(hn::PromoteTo(pair, hn::UpperHalf(half, v)), pair, to + 2);
}

// From the columns to the sums, with n, the box and the faintest pixel's sense left open.
template <int kVectors>
HWY_INLINE void reduce(const ColumnSums* columns, RegionSums& sums) {
  const auto zero = hn::Zero(kQuads);
  const auto one = hn::Set(kColumns, 1);
  auto x = zero, xx = zero, y = zero, xy = zero, yy = zero, v = zero, vx = zero, vy = zero,
       saturated = zero;
  auto faintest = hn::Zero(kColumns);
  for (int i = 0; i < kVectors; ++i) {
    const ColumnSums& c = columns[i];
    const auto column = hn::Iota(kColumns, static_cast<std::int16_t>(i * kVectorColumns));
    x = products(c.n_, column, x);
    xx = products(c.n_, hn::Mul(column, column), xx);
    y = products(c.y_, one, y);
    xy = products(c.y_, column, xy);
    yy = products(c.yy_, one, yy);
    v = products(c.v_, one, v);
    vx = products(c.v_, column, vx);
    vy = products(c.vy_, one, vy);
    saturated = products(c.saturated_, one, saturated);
    faintest = hn::Max(faintest, c.faintest_);
  }
  store(totals(x, xx, y, xy), sums.of.data());
  store(totals(yy, v, vx, vy), sums.of.data() + RegionSums::kYy);
  sums.saturated_px = hn::GetLane(hn::SumOfLanes(kQuads, saturated));
  sums.faintest_dn = hn::GetLane(hn::MaxOfLanes(kColumns, faintest));
}

// The first column of so many vectors that they hold the component; -1 if they cannot.
HWY_INLINE int first_column(const Component& component, int width_px, int vectors) {
  const int columns = vectors * kVectorColumns;
  const int first = std::min<int>(component.x_min, width_px - columns);
  const bool fits =
      component.y_max - component.y_min < kMaxRows && component.x_max - first < columns;
  return fits ? first : -1;
}

// kThresholds: the values are not the pixels themselves.
template <int kVectors, bool kThresholds>
HWY_INLINE void sum(const SumsOf& of, const Component& component, int first_column,
                    RegionSums& sums) {
  const hn::Rebind<std::uint8_t, Columns> bytes;
  const auto flip =
      hn::Set(kColumns, static_cast<std::int16_t>(of.polarity == core::Polarity::bright ? 255 : 0));
  const PixelKey corner = component.y_min * kRowStep + first_column;
  const std::uint8_t* const pixels = of.pixels.row(component.y_min) + first_column;
  const std::ptrdiff_t stride = of.pixels.stride_bytes;
  ColumnSums
      columns[std::size_t{kVectors}];  // not a std::array: its constructor is not of this target
  for (std::uint32_t i = component.head; i != Components::kEnd; i = of.components.next_run(i)) {
    const Run run = of.runs[i];
    const int y = row(run.first - corner);
    const int first = column(run.first - corner);
    const int last = first + run.last - run.first;
    const std::uint8_t* const here = pixels + y * stride;
    for (int k = 0; k < kVectors; ++k) {
      const int c = k * kVectorColumns;
      const Vector pixel = hn::PromoteTo(kColumns, hn::LoadU(bytes, here + c));
      Vector value = pixel;
      if constexpr (kThresholds) {
        const std::uint8_t* const threshold = of.thresholds.row(component.y_min + y) + first_column;
        value = hn::Abs(hn::Sub(pixel, hn::PromoteTo(kColumns, hn::LoadU(bytes, threshold + c))));
      }
      columns[k].add(y, lanes_between(c, first, last), pixel, value, flip);
    }
  }
  reduce<kVectors>(columns, sums);
  if (component.x_min != first_column) [[unlikely]] {
    sums.move_corner(component.x_min - first_column, 0);
  }
  if (of.polarity == core::Polarity::bright) sums.faintest_dn = 255 - sums.faintest_dn;
}

// If so many vectors hold the component.
template <int kVectors>
HWY_INLINE bool try_sum(const SumsOf& of, const Component& component, RegionSums& sums) {
  const int x = first_column(component, of.pixels.width_px, kVectors);
  if (x < 0) return false;
  if (of.thresholds.data != nullptr) {
    sum<kVectors, true>(of, component, x, sums);
  } else {
    sum<kVectors, false>(of, component, x, sums);
  }
  return true;
}

}  // namespace narrow
}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
#endif
