// Sums over the pixels of a small component, without a loop: a row of its box is eight bytes, and
// eight bytes are added up by one instruction.
// Included once a target (foreach_target.h).

#if defined(DOTTRACK_IMAGE_BOX_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DOTTRACK_IMAGE_BOX_SUMS_INL_H_
#undef DOTTRACK_IMAGE_BOX_SUMS_INL_H_
#else
#define DOTTRACK_IMAGE_BOX_SUMS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "app/core/image/region_sums.h"
#include "app/core/image/small_components.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace box {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSide_px = SmallComponent::kSide_px;

#if HWY_TARGET == HWY_SCALAR  // one lane holds no rows

HWY_INLINE void sum(const SumsOf& of, const Component& component, std::uint64_t bits,
                    RegionSums& sums) {
  const bool bright = of.polarity == core::Polarity::bright;
  sums.of = {};
  sums.saturated_px = 0.0;
  sums.faintest_dn = bright ? 255 : 0;
  for (; bits != 0; bits &= bits - 1) {
    const int x = std::countr_zero(bits) % kSide_px;
    const int y = std::countr_zero(bits) / kSide_px;
    const int pixel = of.pixels.row(component.y_min + y)[component.x_min + x];
    int value = pixel;
    if (of.thresholds.data != nullptr) {
      value = std::abs(pixel - of.thresholds.row(component.y_min + y)[component.x_min + x]);
    }
    const std::array<int, 8> terms{x, x * x, y, x * y, y * y, value, value * x, value * y};
    for (std::size_t i = 0; i < terms.size(); ++i) sums.of[i] += terms[i];
    sums.saturated_px += pixel == 255 ? 1.0 : 0.0;
    sums.faintest_dn =
        bright ? std::min(sums.faintest_dn, pixel) : std::max(sums.faintest_dn, pixel);
  }
}

#else

using Bytes = hn::CappedTag<std::uint8_t, 32>;
using Rows = hn::Repartition<std::uint64_t, Bytes>;
using Factors = hn::Repartition<std::uint32_t, Bytes>;
using Pixels = hn::Vec<Bytes>;
using RowSums = hn::Vec<Rows>;  // one number for each row of pixels
constexpr Bytes kBytes;
constexpr Rows kRows;
constexpr int kVectorRows = static_cast<int>(MaxLanes(Rows()));
constexpr int kVectors = kSide_px / kVectorRows;

// Eight bytes a row: the column's number, its square, and each of its bits as a mask.
constexpr int kMostLanes = 32;
using Table = std::array<std::uint8_t, kMostLanes>;
template <class Of>
constexpr Table of_columns(Of of) {
  Table table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<std::uint8_t>(of(static_cast<unsigned>(i % kSide_px)));
  }
  return table;
}
constexpr Table kColumn = of_columns([](unsigned x) { return x; });
constexpr Table kColumnSquared = of_columns([](unsigned x) { return x * x; });
constexpr Table kColumnBit0 = of_columns([](unsigned x) { return (x & 1U) != 0 ? 255 : 0; });
constexpr Table kColumnBit1 = of_columns([](unsigned x) { return (x & 2U) != 0 ? 255 : 0; });
constexpr Table kColumnBit2 = of_columns([](unsigned x) { return (x & 4U) != 0 ? 255 : 0; });

HWY_INLINE Pixels load(const Table& table) {
  return hn::LoadU(kBytes, table.data());
}

// Rows of a box, the first in the lowest lanes. `row(r)` is where row r begins.
template <class D, class Row>
HWY_INLINE hn::Vec<D> load_rows(D d, const Row& row, int r) {
  if constexpr (MaxLanes(d) == kSide_px) {
    return hn::LoadU(d, row(r));
  } else {
    const hn::Half<D> half;
    const auto first = load_rows(half, row, r);
    return hn::Combine(d, load_rows(half, row, r + static_cast<int>(MaxLanes(half)) / kSide_px),
                       first);
  }
}

// Sums that surely fit into 16 bits, four in a lane.
struct Packed {
  RowSums x_xx_y_xy;
  RowSums yy_v_vx_vy;
};

HWY_INLINE RowSums masked_sums(Pixels v, Pixels mask) {
  return hn::SumsOf8(hn::And(v, mask));
}

// row_numbers: of the vector's rows in the box.
HWY_INLINE Packed sum_rows(Pixels inside, Pixels value, RowSums row_numbers) {
  const auto times = [](RowSums a, RowSums b) HWY_ATTR {
    return hn::MulEven(hn::BitCast(Factors(), a), hn::BitCast(Factors(), b));
  };
  const RowSums n = masked_sums(hn::Set(kBytes, 1), inside);
  const RowSums x = masked_sums(load(kColumn), inside);
  const RowSums xx = masked_sums(load(kColumnSquared), inside);
  const RowSums v = hn::SumsOf8(value);
  const RowSums vx = hn::Add(masked_sums(value, load(kColumnBit0)),
                             hn::Add(hn::ShiftLeft<1>(masked_sums(value, load(kColumnBit1))),
                                     hn::ShiftLeft<2>(masked_sums(value, load(kColumnBit2)))));
  const RowSums y_xy = times(hn::Or(n, hn::ShiftLeft<16>(x)), row_numbers);
  const RowSums yy = times(n, times(row_numbers, row_numbers));
  const RowSums vy = times(v, row_numbers);
  return {hn::Or(hn::Or(x, hn::ShiftLeft<16>(xx)), hn::ShiftLeft<32>(y_xy)),
          hn::Or(hn::Or(yy, hn::ShiftLeft<16>(v)),
                 hn::Or(hn::ShiftLeft<32>(vx), hn::ShiftLeft<48>(vy)))};
}

HWY_INLINE void store(RowSums packed, double* to) {
  const hn::FixedTag<std::uint16_t, 4> four;
  const hn::FixedTag<std::int32_t, 4> quads;
  const hn::FixedTag<std::int32_t, 2> pair;
  const hn::FixedTag<double, 2> doubles;
  const hn::FixedTag<std::uint64_t, 1> one;
  const auto total = hn::Set(one, hn::GetLane(hn::SumOfLanes(kRows, packed)));
  const auto v = hn::PromoteTo(quads, hn::BitCast(four, total));
  hn::StoreU(hn::PromoteTo(doubles, hn::LowerHalf(pair, v)), doubles, to);
  hn::StoreU(hn::PromoteTo(doubles, hn::UpperHalf(pair, v)), doubles, to + 2);
}

template <class D, class V = hn::Vec<D> >
HWY_INLINE int greatest(D /*lanes*/, V v) {
  const hn::Half<D> half;
  const auto halves = hn::Max(hn::LowerHalf(half, v), hn::UpperHalf(half, v));
  if constexpr (MaxLanes(half) > 8) {
    return greatest(half, halves);
  } else {
    const hn::FixedTag<std::uint16_t, 8> words;
    return hn::GetLane(hn::MaxOfLanes(words, hn::PromoteTo(words, halves)));
  }
}

// Where the bytes of a box are: as its component's corner, or further from the image's end.
struct Corner {
  int x;
  int y;
};

// kThresholds: the values are not the pixels themselves.
template <bool kThresholds>
HWY_INLINE void sum_at(const SumsOf& of, const Corner& corner, std::uint64_t bits,
                       RegionSums& sums) {
  const bool bright = of.polarity == core::Polarity::bright;
  const Pixels flip = hn::Set(kBytes, static_cast<std::uint8_t>(bright ? 255 : 0));
  const auto pixel_row = [&of, &corner](int r)
                             HWY_ATTR { return of.pixels.row(corner.y + r) + corner.x; };
  const auto threshold_row = [&of, &corner](int r)
                                 HWY_ATTR { return of.thresholds.row(corner.y + r) + corner.x; };
  std::array<std::uint8_t, sizeof(bits)> row_bits{};
  std::memcpy(row_bits.data(), &bits, sizeof(bits));
  Packed packed{hn::Zero(kRows), hn::Zero(kRows)};
  Pixels furthest = hn::Zero(kBytes);
  std::size_t saturated = 0;
  for (int i = 0; i < kVectors; ++i) {
    const int r = i * kVectorRows;
    const Pixels inside = hn::VecFromMask(kBytes, hn::LoadMaskBits(kBytes, row_bits.data() + r));
    const Pixels pixel = hn::And(load_rows(kBytes, pixel_row, r), inside);
    Pixels value = pixel;
    if constexpr (kThresholds) {
      const Pixels threshold = hn::And(load_rows(kBytes, threshold_row, r), inside);
      value = hn::Sub(hn::Max(pixel, threshold), hn::Min(pixel, threshold));
    }
    const Packed rows = sum_rows(inside, value, hn::Iota(kRows, static_cast<std::uint64_t>(r)));
    packed.x_xx_y_xy = hn::Add(packed.x_xx_y_xy, rows.x_xx_y_xy);
    packed.yy_v_vx_vy = hn::Add(packed.yy_v_vx_vy, rows.yy_v_vx_vy);
    saturated += hn::CountTrue(kBytes, hn::Eq(pixel, hn::Set(kBytes, 255)));
    furthest = hn::Max(furthest, hn::And(hn::Xor(pixel, flip), inside));
  }
  store(packed.x_xx_y_xy, sums.of.data());
  store(packed.yy_v_vx_vy, sums.of.data() + RegionSums::kYy);
  sums.saturated_px = static_cast<double>(saturated);
  sums.faintest_dn = bright ? 255 - greatest(kBytes, furthest) : greatest(kBytes, furthest);
}

// The image is at least as large as the box.
HWY_INLINE void sum(const SumsOf& of, const Component& component, std::uint64_t bits,
                    RegionSums& sums) {
  const Corner corner{std::min<int>(component.x_min, of.pixels.width_px - kSide_px),
                      std::min<int>(component.y_min, of.pixels.height_px - kSide_px)};
  const int dx = component.x_min - corner.x;
  const int dy = component.y_min - corner.y;
  bits <<= static_cast<unsigned>(dx + kSide_px * dy);
  if (of.thresholds.data != nullptr) {
    sum_at<true>(of, corner, bits, sums);
  } else {
    sum_at<false>(of, corner, bits, sums);
  }
  if ((dx | dy) != 0) [[unlikely]] {
    sums.move_corner(dx, dy);
  }
}

#endif

}  // namespace box
}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#endif
