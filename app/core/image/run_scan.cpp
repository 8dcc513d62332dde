#include "app/core/image/run_scan.h"

#include <bit>

namespace dottrack::image {

namespace {

// The ends of the runs in one word: a set pixel whose left (right) neighbour is clear, unless no
// neighbour at all is set.
struct RunEnds {
  std::uint64_t first;
  std::uint64_t last;
};

RunEnds run_ends(const std::uint64_t* up, const std::uint64_t* here, const std::uint64_t* down) {
  const std::uint64_t left = *here << 1U | *(here - 1) >> 63U;
  const std::uint64_t right = *here >> 1U | *(here + 1) << 63U;
  const std::uint64_t beside = *up | *down;
  return {*here & ~left & (right | beside), *here & ~right & (left | beside)};
}

// Writes the positions of the set bits, and garbage behind them; returns how many. Two without a
// branch: more in one word are rare, and whether there are none, one or two cannot be predicted.
template <PixelKey Run::*kEnd>
std::size_t write_positions(std::uint64_t bits, PixelKey key, Run* runs) {
  constexpr std::uint64_t kNotZero = std::uint64_t{1} << 63U;
  const std::uint64_t second = bits & (bits - 1);
  runs[0].*kEnd = key + std::countr_zero(bits | kNotZero);
  runs[1].*kEnd = key + std::countr_zero(second | kNotZero);
  std::size_t count = static_cast<std::size_t>(bits != 0) + static_cast<std::size_t>(second != 0);
  for (std::uint64_t rest = second & (second - 1); rest != 0; rest &= rest - 1) {
    runs[count++].*kEnd = key + std::countr_zero(rest);
  }
  return count;
}

}  // namespace

void RunList::clear() {
  size_ = 0;
  overflow_ = 0;
  words_scanned_ = 0;
}

void RunList::scan(const Bitmap& bitmap, int y_end) {
  const std::span<const PixelKey> occupied = bitmap.occupied();
  const std::uint64_t* pixels = bitmap.row(0);
  const std::ptrdiff_t step = bitmap.row(1) - pixels;
  const PixelKey end = y_end * kRowStep;
  std::size_t firsts = size_;
  std::size_t lasts = size_;
  std::size_t i = words_scanned_;
  for (; i < occupied.size() && occupied[i] < end; ++i) {
    const PixelKey key = occupied[i];
    const std::uint64_t* here = pixels + row(key) * step + column(key) / Bitmap::kWordBits;
    const RunEnds ends = run_ends(here - step, here, here + step);
    if (firsts > kCapacity || overflow_ > 0) [[unlikely]] {
      overflow_ += static_cast<std::uint32_t>(std::popcount(ends.first));
      continue;
    }
    firsts += write_positions<&Run::first>(ends.first, key, runs_.data() + firsts);
    lasts += write_positions<&Run::last>(ends.last, key, runs_.data() + lasts);
  }
  words_scanned_ = i;
  size_ = firsts;
  if (size_ > kCapacity) drop_last_row();
}

void RunList::drop_last_row() {
  const int y = row(runs_[size_ - 1].first);
  while (size_ > 0 && row(runs_[size_ - 1].first) == y) {
    dropped_ = runs_[--size_].first;
    ++overflow_;
  }
}

}  // namespace dottrack::image
