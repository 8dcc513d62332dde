#pragma once
// From a bitmap to its horizontal runs.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/bitmap.h"

namespace dottrack::image {

// A longest horizontal sequence of set pixels, both ends included.
struct Run {
  PixelKey first;
  PixelKey last;
};

class RunList {
 public:
  static constexpr std::size_t kCapacity = 131072;

  void clear();
  // Adds the runs of the bitmap's next rows, up to row y_end, leaving out pixels without a
  // 4-neighbour; row y_end is looked at for neighbours. Rows whose runs do not all fit are left
  // out, as is everything below them, and counted.
  void scan(const Bitmap& bitmap, int y_end);

  std::size_t size() const { return size_; }
  const Run& operator[](std::size_t i) const { return runs_[i]; }
  std::uint32_t overflow() const { return overflow_; }  // runs left out
  // Rows from the top whose runs are here, of the given number of rows.
  int rows_searched(int rows) const { return overflow_ == 0 ? rows : row(dropped_); }

 private:
  void drop_last_row();

  static constexpr std::size_t kMaxWordRuns = Bitmap::kWordBits / 2 + 1;
  std::array<Run, kCapacity + kMaxWordRuns> runs_{};
  std::size_t size_ = 0;
  std::uint32_t overflow_ = 0;
  std::size_t words_scanned_ = 0;
  PixelKey dropped_ = 0;  // the first run that was left out
};

}  // namespace dottrack::image
