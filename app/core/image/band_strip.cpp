#include "app/core/image/band_strip.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/band_strip.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/eighths-inl.h"
#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

using Bytes = hn::CappedTag<std::uint8_t, Bitmap::kWordBits>;
using Pixels = hn::Vec<Bytes>;
constexpr Bytes kBytes;
constexpr int kLanes = static_cast<int>(MaxLanes(Bytes()));

// Of a word's columns in each row of the strip: a bit for each pixel in band.
using Words = std::array<std::uint64_t, kStripRows>;

struct Rows {  // of the strip, that lie in the window
  int first;
  int end;
};

// Where a is not more on the polarity's side than b.
template <bool kBright>
HWY_INLINE hn::Mask<Bytes> not_beyond(Pixels a, Pixels b) {
  return hn::Eq(kBright ? hn::Max(a, b) : hn::Min(a, b), b);
}

// Of the columns x, ..., x + 63 of the strip, `pixels` being where its first row has them.
template <bool kBright, bool kFurthest>
HWY_INLINE void look_at(const Strip& strip, const Needed& needed, Rows rows,
                        const std::uint8_t* pixels, std::ptrdiff_t stride, int x, Words& words) {
  const Pixels over = hn::Set(kBytes, needed.over);
  const Pixels floor = hn::Set(kBytes, needed.floor);
  const Pixels flip = hn::Set(kBytes, needed.flip);
  const Pixels furthest = hn::Xor(hn::Set(kBytes, needed.furthest), flip);
  words.fill(0);
  for (int i = 0; i < Bitmap::kWordBits; i += kLanes) {
    const Eighths<Bytes> at(hn::LoadU(kBytes, strip.upper_means + x + i),
                            hn::LoadU(kBytes, strip.lower_means + x + i));
    const auto look = [&](Pixels background, int pair) HWY_ATTR {
      const Pixels flipped = hn::Max(hn::SaturatedAdd(background, over), floor);
      const Pixels threshold = kBright ? flipped : hn::Xor(flipped, flip);
      hn::StoreU(threshold, kBytes, strip.thresholds + pair * strip.stride + x + i);
      for (int y = kRowsPerThreshold * pair; y < kRowsPerThreshold * (pair + 1); ++y) {
        if (y < rows.first || y >= rows.end) continue;
        const Pixels v = hn::LoadU(kBytes, pixels + y * stride + i);
        auto out = not_beyond<kBright>(v, threshold);
        if constexpr (kFurthest) out = hn::Or(out, hn::Not(not_beyond<kBright>(v, furthest)));
        words[static_cast<std::size_t>(y)] |= bits_of(kBytes, out) << static_cast<unsigned>(i);
      }
    };
    look(at.one, 0);
    look(at.three, 1);
    look(at.five, 2);
    look(at.seven, 3);
  }
  // Turning a word around is cheaper than turning its masks.
  for (std::uint64_t& word : words) word = ~word;
}

// Whether a pixel in the columns x, ..., x + 63 may be in band: an average is never less than the
// lesser of the two.
HWY_INLINE bool may_hold(const Strip& strip, const Needed& needed, int x) {
  const Pixels over = hn::Set(kBytes, needed.over);
  const Pixels floor = hn::Set(kBytes, needed.floor);
  auto most = hn::Zero(kBytes);  // by which a peak is beyond the least that is needed
  for (int i = x; i < x + Bitmap::kWordBits; i += kLanes) {
    const Pixels background =
        hn::Min(hn::LoadU(kBytes, strip.upper_means + i), hn::LoadU(kBytes, strip.lower_means + i));
    const Pixels peak =
        hn::Max(hn::LoadU(kBytes, strip.upper_peaks + i), hn::LoadU(kBytes, strip.lower_peaks + i));
    const Pixels least = hn::Max(hn::SaturatedAdd(background, over), floor);
    most = hn::Max(most, hn::SaturatedSub(peak, least));
  }
  return !hn::AllTrue(kBytes, hn::Eq(most, hn::Zero(kBytes)));
}

// The last, incomplete word of the window: with the columns before it or, where there are too few,
// from a copy.
template <bool kBright, bool kFurthest>
HWY_INLINE void look_at_tail(const Strip& strip, const Needed& needed, Rows rows, int x,
                             Words& words) {
  const int count = strip.pixels.width_px - x;
  const int missing = Bitmap::kWordBits - count;
  const std::uint8_t* const pixels = strip.pixels.data + x;
  const std::ptrdiff_t stride = strip.pixels.stride_bytes;
  if (strip.left_px + x >= missing) {
    look_at<kBright, kFurthest>(strip, needed, rows, pixels + strip.y * stride - missing, stride,
                                x - missing, words);
    for (std::uint64_t& word : words) word >>= static_cast<unsigned>(missing);
    return;
  }
  std::uint8_t copy[kStripRows * Bitmap::kWordBits] = {};
  for (int y = rows.first; y < rows.end; ++y) {
    std::memcpy(copy + y * Bitmap::kWordBits, pixels + (strip.y + y) * stride,
                static_cast<std::size_t>(count));
  }
  look_at<kBright, kFurthest>(strip, needed, rows, copy, Bitmap::kWordBits, x, words);
  for (std::uint64_t& word : words) word &= ~std::uint64_t{0} >> static_cast<unsigned>(missing);
}

// `all` tells of each row whether a group has pixels.
template <bool kBright, bool kFurthest>
HWY_INLINE void fill_group(const Strip& strip, const Needed& needed, Rows rows, int w,
                           std::uint64_t* to, Words& all) {
  const int width_px = strip.pixels.width_px;
  const std::uint8_t* const pixels = strip.pixels.data + strip.y * strip.pixels.stride_bytes;
  all.fill(0);
  for (int i = w; i < w + Bitmap::kGroupWords; ++i) {
    const int x = i * Bitmap::kWordBits;
    Words words{};
    if (x < width_px && may_hold(strip, needed, x)) {
      if (x + Bitmap::kWordBits <= width_px) [[likely]] {
        look_at<kBright, kFurthest>(strip, needed, rows, pixels + x, strip.pixels.stride_bytes, x,
                                    words);
      } else {
        look_at_tail<kBright, kFurthest>(strip, needed, rows, x, words);
      }
    }
    for (int y = rows.first; y < rows.end; ++y) {
      const auto r = static_cast<std::size_t>(y);
      all[r] |= words[r];
      to[y * Bitmap::kRowWords + i] = words[r];
    }
  }
}

template <bool kBright, bool kFurthest>
HWY_INLINE void fill_rows(const Strip& strip, const Needed& needed, Rows rows, Bitmap& bitmap) {
  constexpr int kGroupWords = Bitmap::kGroupWords;
  constexpr std::size_t kMaxGroups = Bitmap::kRowWords / kGroupWords;
  std::uint64_t* const to = bitmap.row(0) + std::ptrdiff_t{strip.y} * Bitmap::kRowWords;
  std::array<Words, kMaxGroups> all;
  const int words = (bitmap.width_px() + Bitmap::kWordBits - 1) / Bitmap::kWordBits;
  for (int w = 0; w < words; w += kGroupWords) {
    fill_group<kBright, kFurthest>(strip, needed, rows, w, to,
                                   all[static_cast<std::size_t>(w / kGroupWords)]);
  }
  PixelKey* occupied = bitmap.occupied_end();
  for (int y = rows.first; y < rows.end; ++y) {
    for (int w = 0; w < words; w += kGroupWords) {
      *occupied = (strip.y + y) * kRowStep + w * Bitmap::kWordBits;
      // Whether it is cannot be predicted, so there is no branch for it.
      occupied += all[static_cast<std::size_t>(w / kGroupWords)][static_cast<std::size_t>(y)] != 0;
    }
    std::fill_n(to + y * Bitmap::kRowWords + words, kGroupWords, 0U);
    bitmap.set_occupied_end(strip.y + y, occupied);
  }
}

template <bool kBright, bool kFurthest>
HWY_INLINE void fill_part(const Strip& strip, const Needed& needed, Bitmap& bitmap) {
  const Rows rows{std::max(-strip.y, 0), std::min(bitmap.height_px() - strip.y, kStripRows)};
  if (rows.first == 0 && rows.end == kStripRows) [[likely]] {
    fill_rows<kBright, kFurthest>(strip, needed, {0, kStripRows}, bitmap);
  } else {
    fill_rows<kBright, kFurthest>(strip, needed, rows, bitmap);
  }
}

void fill(const Strip& strip, const Needed& needed, Bitmap& bitmap) {
  const bool all_the_way = needed.furthest == 255;
  if (needed.flip == 0) {
    all_the_way ? fill_part<true, false>(strip, needed, bitmap)
                : fill_part<true, true>(strip, needed, bitmap);
  } else {
    all_the_way ? fill_part<false, false>(strip, needed, bitmap)
                : fill_part<false, true>(strip, needed, bitmap);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(fill);

void fill_strip(const Strip& strip, const Needed& needed, Bitmap& bitmap) {
  HWY_DYNAMIC_DISPATCH(fill)(strip, needed, bitmap);
}

}  // namespace dottrack::image
#endif
