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

  // Collects the runs of the bitmap, row by row, leaving out pixels without a 4-neighbour. Rows
  // whose runs do not all fit are left out, as is everything below them, and counted.
  void scan(const Bitmap& bitmap);

  std::size_t size() const { return size_; }
  const Run& operator[](std::size_t i) const { return runs_[i]; }
  std::uint32_t overflow() const { return overflow_; }  // runs left out
  int rows_searched() const { return rows_searched_; }

 private:
  void drop_last_row();

  static constexpr std::size_t kMaxWordRuns = Bitmap::kWordBits / 2 + 1;
  std::array<Run, kCapacity + kMaxWordRuns> runs_{};
  std::size_t size_ = 0;
  std::uint32_t overflow_ = 0;
  int rows_searched_ = 0;
};

}  // namespace dottrack::image
