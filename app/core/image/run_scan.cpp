#include "app/core/image/run_scan.h"

#include <bit>

namespace dottrack::image {

namespace {

constexpr int kWordBits = Bitmap::kWordBits;

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

}  // namespace

void RunList::scan_row(const Bitmap& bitmap, int y) {
  const std::uint64_t* up = bitmap.row(y - 1);
  const std::uint64_t* here = bitmap.row(y);
  const std::uint64_t* down = bitmap.row(y + 1);
  std::size_t firsts = size_;
  std::size_t lasts = size_;
  for (int w = 0; w < bitmap.words_per_row(); ++w) {
    if (here[w] == 0) continue;
    RunEnds ends = run_ends(up + w, here + w, down + w);
    const PixelKey key = y * kRowStep + w * kWordBits;
    for (; ends.first != 0; ends.first &= ends.first - 1) {
      runs_[firsts++].first = key + std::countr_zero(ends.first);
    }
    for (; ends.last != 0; ends.last &= ends.last - 1) {
      runs_[lasts++].last = key + std::countr_zero(ends.last);
    }
  }
  size_ = firsts;
}

void RunList::scan(const Bitmap& bitmap) {
  size_ = 0;
  overflow_ = 0;
  rows_searched_ = bitmap.height_px();
  for (int y = 0; y < bitmap.height_px(); ++y) {
    const std::size_t before = size_;
    scan_row(bitmap, y);
    if (size_ <= kCapacity && overflow_ == 0) continue;
    if (overflow_ == 0) rows_searched_ = y;
    overflow_ += static_cast<std::uint32_t>(size_ - before);
    size_ = before;
  }
}

}  // namespace dottrack::image
