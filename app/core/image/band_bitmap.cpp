#include "app/core/image/band_bitmap.h"

#include <algorithm>
#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/band_bitmap.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

// How far ahead of a row the image is sent for.
constexpr int kRowsAhead = 2;

// What it takes to be in band, from the cheapest case to the general one.
struct AtLeast {  // v + (255 - lo) + 1 >= 256, as the sign of half of it
  std::uint8_t lo;
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> operator()(D d, V v) const {
    const hn::RebindToSigned<D> of_signs;
    const auto half = hn::AverageRound(v, hn::Set(d, static_cast<std::uint8_t>(255 - lo)));
    return hn::RebindMask(d, hn::Lt(hn::BitCast(of_signs, half), hn::Zero(of_signs)));
  }
};

struct Between {  // lo <= v <= lo + span, as one unsigned comparison: (v - lo) mod 256 <= span
  std::uint8_t lo;
  std::uint8_t span;
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE hn::Mask<D> operator()(D d, V v) const {
    const auto above = hn::Sub(v, hn::Set(d, lo));
    return hn::Eq(hn::Min(above, hn::Set(d, span)), above);
  }
};

HWY_INLINE Between between(std::uint8_t lo, std::uint8_t hi) {
  return {lo, static_cast<std::uint8_t>(hi - lo)};
}

template <class Test>
HWY_INLINE std::uint64_t band_word(const std::uint8_t* pixels, Test in_band) {
  const hn::CappedTag<std::uint8_t, 64> d;
  constexpr std::size_t kLanes = MaxLanes(d);
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 64; i += kLanes) {
    word |= bits_of(d, in_band(d, hn::LoadU(d, pixels + i))) << i;
  }
  return word;
}

// The last, incomplete word of a row. `before` bytes may be read in front of `pixels`.
template <class Test>
HWY_INLINE std::uint64_t band_tail(const std::uint8_t* pixels, int count, int before,
                                   Test in_band) {
  const int missing = 64 - count;
  if (before >= missing) {
    return band_word(pixels - missing, in_band) >> static_cast<unsigned>(missing);
  }
  std::array<std::uint8_t, 64> copy{};
  std::memcpy(copy.data(), pixels, static_cast<std::size_t>(count));
  return band_word(copy.data(), in_band) & (~std::uint64_t{0} >> static_cast<unsigned>(missing));
}

template <class Test>
HWY_INLINE void fill(const ImageView& image, const Window& window, Test in_band, int y_first,
                     int y_end, Bitmap& bitmap) {
  const int full_words = bitmap.width_px() / 64;
  const int tail = bitmap.width_px() % 64;
  constexpr int kGroupWords = Bitmap::kGroupWords;
  static_assert(kGroupWords == 4);
  const std::ptrdiff_t ahead = kRowsAhead * image.stride_bytes;
  PixelKey* occupied = bitmap.occupied_end();
  for (int y = y_first; y < y_end; ++y) {
    const std::uint8_t* pixels = image.row(window.y_min + y) + window.x_min;
    std::uint64_t* words = bitmap.row(y);
    const auto put = [=](int w) HWY_ATTR {
      const std::uint8_t* first = pixels + std::ptrdiff_t{64} * w;
      hwy::Prefetch(first + ahead);
      return words[w] = band_word(first, in_band);
    };
    const auto list = [y, &occupied](int w, std::uint64_t all) HWY_ATTR {
      *occupied = y * kRowStep + 64 * w;
      occupied += all != 0;  // whether it is cannot be predicted, so there is no branch for it
    };
    int w = 0;
    for (; w + kGroupWords <= full_words; w += kGroupWords) {
      list(w, put(w) | put(w + 1) | put(w + 2) | put(w + 3));
    }
    const int group = w;
    std::uint64_t all = 0;
    for (; w < full_words; ++w) all |= put(w);
    if (tail != 0) {
      const int x = 64 * w;
      all |= words[w++] = band_tail(pixels + x, tail, window.x_min + x, in_band);
    }
    if (w > group) list(group, all);
    std::fill_n(words + w, kGroupWords, 0U);
    bitmap.set_occupied_end(y, occupied);
  }
}

// The same of a window that is less than a word wide: all rows begin and end alike. There must be
// 64 pixels in a row, from `before` pixels in front of the window on.
template <class Test>
HWY_INLINE void fill_narrow(const ImageView& image, const Window& window, int before, Test in_band,
                            int y_first, int y_end, Bitmap& bitmap) {
  const auto skipped = static_cast<unsigned>(before);
  const std::uint64_t inside = ~std::uint64_t{0} >> static_cast<unsigned>(64 - bitmap.width_px());
  PixelKey* occupied = bitmap.occupied_end();
  for (int y = y_first; y < y_end; ++y) {
    const std::uint8_t* pixels = image.row(window.y_min + y) + window.x_min;
    std::uint64_t* words = bitmap.row(y);
    words[0] = (band_word(pixels - before, in_band) >> skipped) & inside;
    std::fill_n(words + 1, Bitmap::kGroupWords, 0U);
    *occupied = y * kRowStep;
    occupied += words[0] != 0;
    bitmap.set_occupied_end(y, occupied);
  }
}

template <class Test>
HWY_INLINE void fill_any(const ImageView& image, const Window& window, Test in_band, int y_first,
                         int y_end, Bitmap& bitmap) {
  const int before = std::max(0, window.x_min + 64 - image.width_px);
  if (bitmap.width_px() < 64 && before <= window.x_min) {
    fill_narrow(image, window, before, in_band, y_first, y_end, bitmap);
  } else {
    fill(image, window, in_band, y_first, y_end, bitmap);
  }
}

void fill_rows(const ImageView& image, const Window& window, std::uint8_t lo, std::uint8_t hi,
               int y_first, int y_end, Bitmap& bitmap) {
  if (hi == 255) {
    fill_any(image, window, AtLeast{lo}, y_first, y_end, bitmap);
  } else {
    fill_any(image, window, between(lo, hi), y_first, y_end, bitmap);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(fill_rows);

void fill_band_rows(const ImageView& image, const Window& window, const Band& band, int y_first,
                    int y_end, Bitmap& bitmap) {
  const auto lo = static_cast<std::uint8_t>(std::clamp(band.intensity_min_dn, 0, 255));
  const auto hi = static_cast<std::uint8_t>(std::clamp(band.intensity_max_dn, 0, 255));
  HWY_DYNAMIC_DISPATCH(fill_rows)(image, window, lo, hi, y_first, y_end, bitmap);
}

}  // namespace dottrack::image
#endif
