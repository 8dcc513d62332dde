#include "app/core/image/run_scan.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/run_scan.cpp"
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

// Finds the ends of runs in a group. A run begins (ends) at a pixel with a neighbour whose left
// (right) neighbour is clear. Returns a bit for each word: whether it has an end.
HWY_INLINE unsigned find_ends_in(const std::uint64_t* group, std::uint64_t* first,
                                 std::uint64_t* last) {
  const auto at = [group](std::ptrdiff_t i) HWY_ATTR { return hn::LoadU(kWords, group + i); };
  unsigned some = 0;
  for (int i = 0; i < Bitmap::kGroupWords; i += static_cast<int>(MaxLanes(kWords))) {
    const auto here = at(i);
    const auto left = hn::Or(hn::ShiftLeft<1>(here), hn::ShiftRight<63>(at(i - 1)));
    const auto right = hn::Or(hn::ShiftRight<1>(here), hn::ShiftLeft<63>(at(i + 1)));
    const auto beside = hn::Or(at(i - Bitmap::kRowWords), at(i + Bitmap::kRowWords));
    const auto connected = hn::And(here, hn::Or(beside, hn::Or(left, right)));
    const auto firsts = hn::AndNot(left, connected);
    const auto lasts = hn::AndNot(right, connected);
    hn::StoreU(firsts, kWords, first + i);
    hn::StoreU(lasts, kWords, last + i);
    const auto none = hn::Eq(hn::Or(firsts, lasts), hn::Zero(kWords));
    some |= static_cast<unsigned>(~bits_of(kWords, none) & ((1U << MaxLanes(kWords)) - 1)) << i;
  }
  return some;
}

// Lists the words that have an end. Whether one has cannot be predicted, so there
// is no branch for it.
std::size_t find_ends(const Bitmap& bitmap, std::span<const PixelKey> groups, EndWords& found) {
  std::size_t count = 0;
  std::size_t at = 0;
  for (const PixelKey group : groups) {
    const unsigned some =
        find_ends_in(bitmap.word(group), found.first.data() + at, found.last.data() + at);
    count += list_set_bits(some, at, found.listed.data() + count);
    at += Bitmap::kGroupWords;
  }
  return count;
}

template <PixelKey Run::*kEnd>
struct EndOf {
  Run* runs;

  PixelKey& operator[](int i) const { return runs[i].*kEnd; }
};

// The k-th beginning belongs to the k-th end.
RunCounts scan_groups(const Bitmap& bitmap, std::span<const PixelKey> groups, EndWords& ends,
                      Run* runs, RunCounts counts) {
  constexpr std::size_t kGroupWords = Bitmap::kGroupWords;
  constexpr std::size_t kBits = Bitmap::kWordBits;
  const std::size_t words = find_ends(bitmap, groups, ends);
  for (std::size_t k = 0; k < words; ++k) {
    const std::size_t i = ends.listed[k];
    const PixelKey key = groups[i / kGroupWords] + static_cast<PixelKey>(i % kGroupWords * kBits);
    counts.firsts += write_positions(ends.first[i], key, EndOf<&Run::first>{runs + counts.firsts});
    counts.lasts += write_positions(ends.last[i], key, EndOf<&Run::last>{runs + counts.lasts});
  }
  return counts;
}

std::size_t count_runs(const Bitmap& bitmap, std::span<const PixelKey> groups, EndWords& ends) {
  const std::size_t words = find_ends(bitmap, groups, ends);
  int count = 0;
  for (std::size_t k = 0; k < words; ++k) count += std::popcount(ends.first[ends.listed[k]]);
  return static_cast<std::size_t>(count);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(scan_groups);
HWY_EXPORT(count_runs);

void RunList::scan(const Bitmap& bitmap, std::span<const PixelKey> listed) {
  counts_ = {};
  overflow_ = 0;
  rows_searched_ = bitmap.height_px();
  for (std::size_t at = 0; at < listed.size(); at += EndWords::kMaxGroups) {
    const std::size_t count = std::min(listed.size() - at, EndWords::kMaxGroups);
    const std::span<const PixelKey> groups = listed.subspan(at, count);
    if (overflow_ > 0) {
      overflow_ +=
          static_cast<std::uint32_t>(HWY_DYNAMIC_DISPATCH(count_runs)(bitmap, groups, ends_));
      continue;
    }
    counts_ = HWY_DYNAMIC_DISPATCH(scan_groups)(bitmap, groups, ends_, runs_.data(), counts_);
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
