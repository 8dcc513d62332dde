#include "app/core/image/beginnings.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/beginnings.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/simd_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint64_t, Bitmap::kGroupWords>;
constexpr Words kWords;

// Of a group of words, the pixels that have a 4-neighbour, and one pixel of each run with nothing
// above it: its last one, or the word's. Returns a bit for each word: whether it has one of these.
HWY_INLINE unsigned look_at_group(const std::uint64_t* group, std::uint64_t* connected,
                                  std::uint64_t* beginnings) {
  const auto at = [group](std::ptrdiff_t i) HWY_ATTR { return hn::LoadU(kWords, group + i); };
  const auto last_bit = hn::Set(kWords, std::uint64_t{1} << 63U);
  unsigned some = 0;
  for (int i = 0; i < Bitmap::kGroupWords; i += static_cast<int>(MaxLanes(kWords))) {
    const auto all = at(i);
    const auto above = at(i - Bitmap::kRowWords);
    const auto left = hn::Or(hn::ShiftLeft<1>(all), hn::ShiftRight<63>(at(i - 1)));
    const auto right = hn::Or(hn::ShiftRight<1>(all), hn::ShiftLeft<63>(at(i + 1)));
    const auto beside = hn::Or(above, at(i + Bitmap::kRowWords));
    const auto here = hn::And(all, hn::Or(beside, hn::Or(left, right)));
    hn::StoreU(here, kWords, connected + i);
    // Added to a run, its first bit is carried on to behind its end, or to where it touches the row
    // above; some carry out of the word.
    const auto free = hn::AndNot(above, here);
    const auto first = hn::AndNot(left, free);
    const auto sum = hn::Add(free, first);
    const auto carry = hn::Or(hn::And(free, first), hn::AndNot(sum, hn::Or(free, first)));
    const auto behind = hn::AndNot(here, sum);
    const auto begins = hn::Or(hn::ShiftRight<1>(behind), hn::And(carry, last_bit));
    hn::StoreU(begins, kWords, beginnings + i);
    const auto none = hn::Eq(begins, hn::Zero(kWords));
    some |= static_cast<unsigned>(bits_of(kWords, none) ^ ((1U << MaxLanes(kWords)) - 1)) << i;
  }
  return some;
}

// Whether a word has a beginning cannot be predicted, so
// there is no branch for it.
void find(const Bitmap& bitmap, std::span<const PixelKey> groups, std::uint64_t* connected,
          LinesAhead& lines, Beginnings& found) {
  LinesAhead ahead = lines;  // nothing else that is written can be meant by it
  std::size_t words = 0;
  std::size_t at = 0;
  for (const PixelKey group : groups) {
    ahead.send();
    const unsigned some =
        look_at_group(bitmap.word(group), connected + at, found.words.data() + at);
    words += list_set_bits(some, at, found.listed.data() + words);
    at += Bitmap::kGroupWords;
  }
  for (std::size_t k = 0; k < words; ++k) {
    ahead.send();
    const std::size_t i = found.listed[k];
    const PixelKey key = groups[i / Bitmap::kGroupWords] +
                         static_cast<PixelKey>(i % Bitmap::kGroupWords * Bitmap::kWordBits);
    found.size += write_positions(found.words[i], key, found.pixels.data() + found.size);
  }
  lines = ahead;
}

// Whether a group has pixels left cannot be predicted, so there is no branch for it.
std::size_t list_left(const Bitmap& bitmap, std::span<const PixelKey> groups,
                      const std::uint64_t* connected, PixelKey* left) {
  PixelKey* next = left;
  for (const PixelKey group : groups) {
    auto some = hn::Zero(kWords);
    for (std::size_t i = 0; i < Bitmap::kGroupWords; i += MaxLanes(kWords)) {
      some = hn::Or(some, hn::And(hn::LoadU(kWords, bitmap.word(group) + i),
                                  hn::LoadU(kWords, connected + i)));
    }
    *next = group;
    next += !hn::AllTrue(kWords, hn::Eq(some, hn::Zero(kWords)));
    connected += Bitmap::kGroupWords;
  }
  return static_cast<std::size_t>(next - left);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(find);
HWY_EXPORT(list_left);

void find_beginnings(const Bitmap& bitmap, std::span<const PixelKey> groups,
                     std::uint64_t* connected, LinesAhead& ahead, Beginnings& found) {
  HWY_DYNAMIC_DISPATCH(find)(bitmap, groups, connected, ahead, found);
}

std::size_t list_groups_left(const Bitmap& bitmap, std::span<const PixelKey> groups,
                             const std::uint64_t* connected, PixelKey* left) {
  return HWY_DYNAMIC_DISPATCH(list_left)(bitmap, groups, connected, left);
}

}  // namespace dottrack::image
#endif
