#include "app/core/image/run_scan.h"

#include <algorithm>
#include <bit>

// Not for its vectors, but for the bit counting that comes with the processor's instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/run_scan.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {

// Writes the positions of the set bits, and garbage behind them; returns how many. Two without a
// branch: more in one word are rare, and whether there are none, one or two cannot be predicted.
template <PixelKey Run::*kEnd>
HWY_INLINE std::size_t write_positions(std::uint64_t bits, PixelKey key, Run* runs) {
  const std::uint64_t second = bits & (bits - 1);
  runs[0].*kEnd = key + std::countr_zero(bits);
  runs[1].*kEnd = key + std::countr_zero(second);
  std::uint64_t rest = second & (second - 1);
  for (Run* run = runs + 2; rest != 0; rest &= rest - 1) {
    (run++)->*kEnd = key + std::countr_zero(rest);
  }
  return static_cast<std::size_t>(std::popcount(bits));
}

// A run begins (ends) at a set pixel whose left (right) neighbour is clear, unless no neighbour at
// all is set. Whether a word has such a pixel cannot be predicted, so there is no branch for it.
HWY_INLINE std::size_t find_ends(const Bitmap& bitmap, std::span<const PixelKey> words,
                                 EndWord* found) {
  EndWord* end = found;
  for (const PixelKey key : words) {
    const std::uint64_t* here = bitmap.word(key);
    const std::uint64_t left = *here << 1U | *(here - 1) >> 63U;
    const std::uint64_t right = *here >> 1U | *(here + 1) << 63U;
    const std::uint64_t beside = *(here - Bitmap::kRowWords) | *(here + Bitmap::kRowWords);
    const std::uint64_t first = *here & ~left & (right | beside);
    const std::uint64_t last = *here & ~right & (left | beside);
    *end = {first, last, key};
    end += (first | last) != 0;
  }
  return static_cast<std::size_t>(end - found);
}

// The k-th beginning belongs to the k-th end.
RunCounts scan_words(const Bitmap& bitmap, std::span<const PixelKey> words, EndWord* scratch,
                     Run* runs, RunCounts counts) {
  const std::size_t end_words = find_ends(bitmap, words, scratch);
  for (std::size_t i = 0; i < end_words; ++i) {
    const EndWord& word = scratch[i];
    counts.firsts += write_positions<&Run::first>(word.first, word.key, runs + counts.firsts);
    counts.lasts += write_positions<&Run::last>(word.last, word.key, runs + counts.lasts);
  }
  return counts;
}

std::size_t count_runs(const Bitmap& bitmap, std::span<const PixelKey> words, EndWord* scratch) {
  const std::size_t end_words = find_ends(bitmap, words, scratch);
  int count = 0;
  for (std::size_t i = 0; i < end_words; ++i) count += std::popcount(scratch[i].first);
  return static_cast<std::size_t>(count);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(scan_words);
HWY_EXPORT(count_runs);

void RunList::clear() {
  counts_ = {};
  overflow_ = 0;
  words_scanned_ = 0;
  rows_searched_ = 0;
}

void RunList::scan(const Bitmap& bitmap, int y_end) {
  const std::span<const PixelKey> listed = bitmap.occupied();
  const auto stop = std::lower_bound(listed.begin() + static_cast<std::ptrdiff_t>(words_scanned_),
                                     listed.end(), y_end * kRowStep);
  const auto words_end = static_cast<std::size_t>(stop - listed.begin());
  if (overflow_ == 0) rows_searched_ = y_end;
  while (words_scanned_ < words_end) {
    const std::size_t count = std::min(words_end - words_scanned_, kMaxWords);
    const std::span<const PixelKey> words = listed.subspan(words_scanned_, count);
    words_scanned_ += count;
    if (overflow_ > 0) {
      overflow_ += static_cast<std::uint32_t>(
          HWY_DYNAMIC_DISPATCH(count_runs)(bitmap, words, end_words_.data()));
      continue;
    }
    counts_ =
        HWY_DYNAMIC_DISPATCH(scan_words)(bitmap, words, end_words_.data(), runs_.data(), counts_);
    if (size() > kCapacity) take_back_rows_that_overflow();
  }
}

void RunList::take_back_rows_that_overflow() {
  const std::size_t size_with = size();
  std::size_t kept = size_with;
  rows_searched_ = row(runs_[kCapacity].first);
  while (kept > 0 && row(runs_[kept - 1].first) >= rows_searched_) --kept;
  counts_ = {kept, kept};
  overflow_ += static_cast<std::uint32_t>(size_with - kept);
}

}  // namespace dottrack::image
#endif
