#include "app/core/image/tile_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/tile_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The sum of one tile of any size.
HWY_INLINE std::uint16_t sum_tile(const ImageView& pixels, int x) {
  int sum = 0;
  const int x_end = std::min(x + kTile_px, pixels.width_px);
  for (int y = 0; y < pixels.height_px; ++y) {
    for (int i = x; i < x_end; ++i) sum += pixels.row(y)[i];
  }
  return static_cast<std::uint16_t>(sum);
}

#if HWY_TARGET != HWY_SCALAR

// Of whole rows of tiles, 64 pixels at a time; returns where it ended.
HWY_INLINE int sum_whole_tiles(const ImageView& pixels, std::uint16_t* sums) {
  const hn::CappedTag<std::uint8_t, 32> bytes;
  const hn::RepartitionToWide<hn::RepartitionToWide<hn::RepartitionToWide<decltype(bytes)>>> eights;
  const hn::Rebind<std::uint16_t, decltype(eights)> narrow;
  constexpr int kStep = static_cast<int>(MaxLanes(bytes));
  const int x_end = pixels.width_px / 64 * 64;
  for (int x = 0; x < x_end; x += 64) {
    const std::uint8_t* row = pixels.data + x;
    hn::Vec<decltype(eights)> sum[64 / kStep];
#pragma GCC unroll 4
    for (auto& s : sum) s = hn::Zero(eights);
#pragma GCC unroll 8
    for (int y = 0; y < kTile_px; ++y) {
#pragma GCC unroll 4
      for (int i = 0; i < 64 / kStep; ++i) {
        sum[i] = hn::Add(sum[i], hn::SumsOf8(hn::LoadU(bytes, row + i * kStep)));
      }
      row += pixels.stride_bytes;
    }
#pragma GCC unroll 4
    for (int i = 0; i < 64 / kStep; ++i) {
      hn::StoreU(hn::TruncateTo(narrow, sum[i]), narrow, sums + (x + i * kStep) / kTile_px);
    }
  }
  return x_end;
}

#endif

void sum_row(const ImageView& pixels, std::uint16_t* sums) {
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  if (pixels.height_px == kTile_px) x = sum_whole_tiles(pixels, sums);
#endif
  for (; x < pixels.width_px; x += kTile_px) sums[x / kTile_px] = sum_tile(pixels, x);
}

void slide(const std::uint16_t* added, const std::uint16_t* dropped, int n, std::int32_t* sums) {
  const hn::CappedTag<std::int32_t, 8> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  constexpr int kStep = static_cast<int>(MaxLanes(d));
  int i = 0;
  for (; i + kStep <= n; i += kStep) {
    const auto in = hn::PromoteTo(d, hn::LoadU(d16, added + i));
    const auto out = hn::PromoteTo(d, hn::LoadU(d16, dropped + i));
    hn::StoreU(hn::Sub(hn::Add(hn::LoadU(d, sums + i), in), out), d, sums + i);
  }
  for (; i < n; ++i) sums[i] += added[i] - dropped[i];
}

// The sums are exact in single precision: below 2^24.
void means_of(const TileBoxes& boxes, const RelativeContrast& contrast, int n,
              std::uint8_t* means) {
  const hn::CappedTag<std::int32_t, 8> d;
  const hn::RebindToFloat<decltype(d)> df;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  constexpr int kStep = static_cast<int>(MaxLanes(d));
  const auto part = hn::Set(d, contrast.part_256ths);
  const auto absolute = hn::Set(d, contrast.absolute_dn);
  const auto flip = hn::Set(d, std::int32_t{contrast.flip});
  for (int i = 0; i < n; i += kStep) {
    auto sum = hn::LoadU(d, boxes.column_sums + i);
    for (int k = 1; k < boxes.box; ++k) {
      sum = hn::Add(sum, hn::LoadU(d, boxes.column_sums + i + k));
    }
    sum = hn::Abs(hn::Sub(hn::LoadU(d, boxes.brightest + i), sum));
    const auto mean = hn::Mul(hn::ConvertTo(df, sum), hn::LoadU(df, boxes.per_count + i));
    const auto background = hn::NearestInt(mean);
    const auto relative =
        hn::ShiftRight<8>(hn::Add(hn::Mul(hn::Xor(background, flip), part), hn::Set(d, 128)));
    const auto more = hn::Max(hn::Sub(relative, absolute), hn::Zero(d));
    hn::StoreU(hn::DemoteTo(d8, hn::Add(background, more)), d8, means + i);
  }
}

// One, three, five and seven eighths of the way from a to b, each average rounded up.
template <class D, class V = hn::Vec<D>>
struct Eighths {
  HWY_INLINE Eighths(V a, V b) {
    const V middle = hn::AverageRound(a, b);
    const V quarter = hn::AverageRound(a, middle);
    const V three_quarters = hn::AverageRound(middle, b);
    one = hn::AverageRound(a, quarter);
    three = hn::AverageRound(quarter, middle);
    five = hn::AverageRound(middle, three_quarters);
    seven = hn::AverageRound(three_quarters, b);
  }

  V one, three, five, seven;
};

// Of the complements, so that averages are rounded down: those between rows are rounded up, and
// together they favour neither.
void stretch_row(const std::uint8_t* means, int n, std::uint8_t* row) {
  const hn::CappedTag<std::uint16_t, 16> pairs;
  const hn::Rebind<std::uint8_t, decltype(pairs)> bytes;
  constexpr int kStep = static_cast<int>(MaxLanes(pairs));
  const auto twice = hn::Set(pairs, 0x0101);
  for (int i = 0; i < n; i += kStep) {
    const Eighths<decltype(bytes)> at(hn::Not(hn::LoadU(bytes, means + i)),
                                      hn::Not(hn::LoadU(bytes, means + i + 1)));
    const auto pair = [&](auto v)
                          HWY_ATTR { return hn::Mul(hn::PromoteTo(pairs, hn::Not(v)), twice); };
    // The bytes of a pair are equal, so their order does not matter.
    hn::StoreInterleaved4(pair(at.one), pair(at.three), pair(at.five), pair(at.seven), pairs,
                          reinterpret_cast<std::uint16_t*>(row + i * kTile_px));
  }
}

void make_thresholds(const std::uint8_t* upper, const std::uint8_t* lower, int n,
                     const Needed& needed, std::uint8_t* thresholds, std::ptrdiff_t stride) {
  const hn::CappedTag<std::uint8_t, 64> d;
  constexpr int kStep = static_cast<int>(MaxLanes(d));
  const auto over = hn::Set(d, needed.over);
  const auto floor = hn::Set(d, needed.floor);
  const auto flip = hn::Set(d, needed.flip);
  for (int i = 0; i < n; i += kStep) {
    const Eighths<decltype(d)> at(hn::LoadU(d, upper + i), hn::LoadU(d, lower + i));
    const auto put = [&](auto background, std::ptrdiff_t row) HWY_ATTR {
      const auto threshold = hn::Max(hn::SaturatedAdd(background, over), floor);
      hn::StoreU(hn::Xor(threshold, flip), d, thresholds + row * stride + i);
    };
    put(at.one, 0);
    put(at.three, 1);
    put(at.five, 2);
    put(at.seven, 3);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(sum_row);
HWY_EXPORT(slide);
HWY_EXPORT(means_of);
HWY_EXPORT(stretch_row);
HWY_EXPORT(make_thresholds);

void sum_tiles(const ImageView& pixels, std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(sum_row)(pixels, sums);
}

void slide_tiles(const std::uint16_t* added, const std::uint16_t* dropped, int n,
                 std::int32_t* sums) {
  HWY_DYNAMIC_DISPATCH(slide)(added, dropped, n, sums);
}

void mean_of_boxes(const TileBoxes& boxes, const RelativeContrast& contrast, int n,
                   std::uint8_t* means) {
  HWY_DYNAMIC_DISPATCH(means_of)(boxes, contrast, n, means);
}

void stretch(const std::uint8_t* means, int n, std::uint8_t* row) {
  HWY_DYNAMIC_DISPATCH(stretch_row)(means, n, row);
}

void thresholds_between(const std::uint8_t* upper, const std::uint8_t* lower, int n,
                        const Needed& needed, std::uint8_t* thresholds, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(make_thresholds)(upper, lower, n, needed, thresholds, stride);
}

}  // namespace dottrack::image
#endif
