#include "app/core/image/tile_rows.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/tile_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "app/core/image/eighths-inl.h"

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

constexpr int kLine_px = 64;

// As many whole tiles as some vectors hold columns. Of those that fill cache lines the tiles below
// are sent for: in a picture with little in it nothing else does so in time.
template <bool kBright, int kVectors, class D>
HWY_INLINE void sum_tiles_in(D bytes, const ImageView& pixels, int x, std::uint16_t* sums,
                             const TilePeaks& peaks) {
  constexpr int kStep = static_cast<int>(MaxLanes(D()));
  const hn::Repartition<std::uint64_t, D> eights;
  const hn::Rebind<std::uint16_t, decltype(eights)> narrow;
  const std::uint8_t* row = pixels.data + x;
  hn::Vec<decltype(eights)> sum[std::size_t{kVectors}];
  for (auto& s : sum) s = hn::Zero(eights);
  for (std::uint8_t* const to : {peaks.upper + x, peaks.lower + x}) {
    hn::Vec<D> furthest[std::size_t{kVectors}];
    for (auto& f : furthest) f = hn::Set(bytes, kBright ? 0 : 255);
#pragma GCC unroll 4
    for (int y = 0; y < kTile_px / 2; ++y) {
      if (kVectors * kStep == kLine_px) hwy::Prefetch(row + kTile_px * pixels.stride_bytes);
#pragma GCC unroll 4
      for (int i = 0; i < kVectors; ++i) {
        const auto v = hn::LoadU(bytes, row + i * kStep);
        sum[i] = hn::Add(sum[i], hn::SumsOf8(v));
        furthest[i] = kBright ? hn::Max(furthest[i], v) : hn::Min(furthest[i], v);
      }
      row += pixels.stride_bytes;
    }
    for (int i = 0; i < kVectors; ++i) {
      hn::StoreU(kBright ? furthest[i] : hn::Not(furthest[i]), bytes, to + i * kStep);
    }
  }
  for (int i = 0; i < kVectors; ++i) {
    hn::StoreU(hn::TruncateTo(narrow, sum[i]), narrow, sums + (x + i * kStep) / kTile_px);
  }
}

// Of whole rows of tiles; returns where it ended.
template <bool kBright>
HWY_INLINE int sum_whole_tiles(const ImageView& pixels, std::uint16_t* sums,
                               const TilePeaks& peaks) {
  const hn::CappedTag<std::uint8_t, kLine_px / 2> bytes;
  const hn::FixedTag<std::uint8_t, kTile_px> tile;
  constexpr int kVectors = kLine_px / static_cast<int>(MaxLanes(bytes));
  int x = 0;
  for (; x + kLine_px <= pixels.width_px; x += kLine_px) {
    sum_tiles_in<kBright, kVectors>(bytes, pixels, x, sums, peaks);
  }
  for (; x + kTile_px <= pixels.width_px; x += kTile_px) {
    sum_tiles_in<kBright, 1>(tile, pixels, x, sums, peaks);
  }
  return x;
}

#endif

void sum_row(const ImageView& pixels, [[maybe_unused]] Flip flip, std::uint16_t* sums,
             const TilePeaks& peaks) {
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  if (pixels.height_px == kTile_px) {
    x = flip == 0 ? sum_whole_tiles<true>(pixels, sums, peaks)
                  : sum_whole_tiles<false>(pixels, sums, peaks);
  }
#endif
  const auto rest_px = static_cast<std::size_t>(pixels.width_px - x);
  std::memset(peaks.upper + x, 255, rest_px);
  std::memset(peaks.lower + x, 255, rest_px);
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

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(sum_row);
HWY_EXPORT(slide);
HWY_EXPORT(means_of);
HWY_EXPORT(stretch_row);

void sum_tiles(const ImageView& pixels, Flip flip, std::uint16_t* sums, const TilePeaks& peaks) {
  HWY_DYNAMIC_DISPATCH(sum_row)(pixels, flip, sums, peaks);
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

}  // namespace dottrack::image
#endif
