#include "app/core/image/box_row.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/box_row.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

void slide(const std::uint8_t* added, const std::uint8_t* dropped, Flip flip, int n,
           std::uint16_t* sums) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto mask = hn::Set(d8, flip);
  const auto count = static_cast<std::size_t>(n);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const auto in = hn::PromoteTo(d, hn::Xor(hn::LoadU(d8, added + i), mask));
    const auto out = hn::PromoteTo(d, hn::Xor(hn::LoadU(d8, dropped + i), mask));
    hn::StoreU(hn::Sub(hn::Add(hn::LoadU(d, sums + i), in), out), d, sums + i);
  }
  for (; i < count; ++i) {
    sums[i] = static_cast<std::uint16_t>(sums[i] + (added[i] ^ flip) - (dropped[i] ^ flip));
  }
}

#if HWY_TARGET == HWY_SCALAR

void totals_of(const std::uint16_t* sums, int n, std::int32_t* totals) {
  totals[0] = 0;
  for (int i = 0; i < n; ++i) totals[i + 1] = totals[i] + sums[i];
}

#else

// Four columns a step: two shifted additions sum them among themselves, then comes what was before.
// May write up to three totals behind the last.
void totals_of(const std::uint16_t* sums, int n, std::int32_t* totals) {
  const hn::FixedTag<std::int32_t, 4> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  auto before = hn::Zero(d);
  totals[0] = 0;
  for (int i = 0; i < n; i += 4) {
    auto v = hn::PromoteTo(d, hn::LoadU(d16, sums + i));
    v = hn::Add(v, hn::ShiftLeftLanes<1>(d, v));
    v = hn::Add(v, hn::ShiftLeftLanes<2>(d, v));
    before = hn::Add(before, v);
    hn::StoreU(before, d, totals + i + 1);
    before = hn::Broadcast<3>(before);
  }
}

#endif

using Lanes = hn::CappedTag<std::int32_t, 8>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));

HWY_INLINE Vector pixels_at(const std::uint8_t* pixels, Flip flip) {
  const hn::Rebind<std::uint8_t, Lanes> d8;
  return hn::PromoteTo(kLanes, hn::Xor(hn::LoadU(d8, pixels), hn::Set(d8, flip)));
}

HWY_INLINE Vector sums_at(const BoxRow& row, int i) {
  return hn::Sub(hn::LoadU(kLanes, row.totals + i + row.box_px), hn::LoadU(kLanes, row.totals + i));
}

// `pixels` are those of the word that begins at pixel x.
HWY_INLINE std::uint64_t contrast_word(const BoxRow& row, const std::uint8_t* pixels, int x) {
  const auto contrast = hn::Set(kLanes, row.contrast_dn);
  std::uint64_t too_small = 0;
  for (int i = 0; i < 64; i += kStep) {
    const auto above = hn::Sub(pixels_at(pixels + i, row.flip), contrast);
    const auto least = hn::Mul(above, hn::LoadU(kLanes, row.counts + x + i));
    too_small |= bits_of(kLanes, hn::Gt(sums_at(row, x + i), least)) << static_cast<unsigned>(i);
  }
  return ~too_small;
}

HWY_INLINE void store_excess(const BoxRow& row, const std::uint8_t* pixels, int x,
                             std::uint8_t* excess) {
  const hn::RebindToFloat<Lanes> df;
  const hn::Rebind<std::uint8_t, Lanes> d8;
  const auto least = hn::Set(kLanes, row.contrast_dn - 1);
  for (int i = 0; i < 64; i += kStep) {
    const auto sum = hn::ConvertTo(df, sums_at(row, x + i));  // exact: below 2^24
    const auto mean = hn::NearestInt(hn::Mul(sum, hn::LoadU(df, row.per_count + x + i)));
    const auto over = hn::Sub(hn::Sub(pixels_at(pixels + i, row.flip), mean), least);
    hn::StoreU(hn::DemoteTo(d8, over), d8, excess + x + i);
  }
}

void keep_row(const BoxRow& row, int words_per_row, std::uint64_t* words, std::uint8_t* excess) {
  for (int w = 0; w < words_per_row; ++w) {
    if (words[w] == 0) continue;
    const int x = 64 * w;
    const std::uint8_t* pixels = row.pixels + x;
    std::array<std::uint8_t, 64> copy{};
    if (row.room - x < 64) {
      std::memcpy(copy.data(), pixels, static_cast<std::size_t>(row.room - x));
      pixels = copy.data();
    }
    words[w] &= contrast_word(row, pixels, x);
    if (words[w] != 0) store_excess(row, pixels, x, excess);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(slide);
HWY_EXPORT(totals_of);
HWY_EXPORT(keep_row);

void slide_columns(const std::uint8_t* added, const std::uint8_t* dropped, Flip flip, int n,
                   std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(slide)(added, dropped, flip, n, sums);
}

void running_totals(const std::uint16_t* sums, int n, std::int32_t* totals) {
  HWY_DYNAMIC_DISPATCH(totals_of)(sums, n, totals);
}

void keep_contrast(const BoxRow& row, int words_per_row, std::uint64_t* words,
                   std::uint8_t* excess) {
  HWY_DYNAMIC_DISPATCH(keep_row)(row, words_per_row, words, excess);
}

}  // namespace dottrack::image
#endif
