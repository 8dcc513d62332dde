#include "app/core/image/band_bitmap.h"

#include <algorithm>
#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/band_bitmap.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

// lo <= v <= lo + span, as one unsigned comparison: (v - lo) mod 256 <= span.
struct ByteBand {
  std::uint8_t lo;
  std::uint8_t span;
};

HWY_INLINE std::uint64_t band_word(const std::uint8_t* pixels, ByteBand band) {
  const hn::CappedTag<std::uint8_t, 64> d;
  constexpr std::size_t kLanes = MaxLanes(d);
  const auto lo = hn::Set(d, band.lo);
  const auto span = hn::Set(d, band.span);
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 64; i += kLanes) {
    const auto above = hn::Sub(hn::LoadU(d, pixels + i), lo);
    word |= bits_of(d, hn::Eq(hn::Min(above, span), above)) << i;
  }
  return word;
}

// The last, incomplete word of a row. `before` bytes may be read in front of `pixels`.
HWY_INLINE std::uint64_t band_tail(const std::uint8_t* pixels, int count, int before,
                                   ByteBand band) {
  const int missing = 64 - count;
  if (before >= missing) {
    return band_word(pixels - missing, band) >> static_cast<unsigned>(missing);
  }
  std::array<std::uint8_t, 64> copy{};
  std::memcpy(copy.data(), pixels, static_cast<std::size_t>(count));
  return band_word(copy.data(), band);
}

void fill_rows(const ImageView& image, const Window& window, std::uint8_t lo, std::uint8_t span,
               Bitmap& bitmap) {
  const ByteBand band{lo, span};
  const int full_words = bitmap.width_px() / 64;
  const int tail = bitmap.width_px() % 64;
  const std::uint64_t tail_mask = bitmap.last_word_mask();
  PixelKey* occupied = bitmap.occupied_begin();
  for (int y = 0; y < bitmap.height_px(); ++y) {
    const std::uint8_t* pixels = image.row(window.y_min + y) + window.x_min;
    std::uint64_t* words = bitmap.row(y);
    for (int w = 0; w < full_words; ++w) {
      words[w] = band_word(pixels + 64 * w, band);
      *occupied = y * kRowStep + 64 * w;
      occupied += words[w] != 0;
    }
    if (tail != 0) {
      const int x = 64 * full_words;
      words[full_words] = band_tail(pixels + x, tail, window.x_min + x, band) & tail_mask;
      *occupied = y * kRowStep + x;
      occupied += words[full_words] != 0;
    }
  }
  bitmap.set_occupied_end(occupied);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(fill_rows);

namespace {

void clear_rows(Bitmap& bitmap) {
  for (int y = 0; y < bitmap.height_px(); ++y) {
    std::fill_n(bitmap.row(y), bitmap.words_per_row(), 0U);
  }
}

}  // namespace

void fill_band_bitmap(const ImageView& image, const Window& window, const Band& band,
                      Bitmap& bitmap) {
  bitmap.reshape(window.x_max - window.x_min + 1, window.y_max - window.y_min + 1);
  const int lo = std::max(band.intensity_min_dn, 0);
  const int hi = std::min(band.intensity_max_dn, 255);
  if (lo > hi) {
    clear_rows(bitmap);
    return;
  }
  HWY_DYNAMIC_DISPATCH(fill_rows)
  (image, window, static_cast<std::uint8_t>(lo), static_cast<std::uint8_t>(hi - lo), bitmap);
}

}  // namespace dottrack::image
#endif
