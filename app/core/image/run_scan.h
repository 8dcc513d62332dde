#pragma once
// From a bitmap to its horizontal runs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/image/bitmap.h"

namespace dottrack::image {

// A longest horizontal sequence of set pixels, both ends included.
struct Run {
  PixelKey first;
  PixelKey last;
};

// One word's part of the runs: one bit for the first and for the last pixel of each.
struct EndWord {
  std::uint64_t first;
  std::uint64_t last;
  PixelKey key;
};

// A run may have begun in one word and end in another.
struct RunCounts {
  std::size_t firsts = 0;
  std::size_t lasts = 0;
};

class RunList {
 public:
  static constexpr std::size_t kCapacity = 131072;

  void clear();
  // Adds the runs of the bitmap's next rows, up to row y_end, leaving out pixels without a
  // 4-neighbour; row y_end is looked at for neighbours. Rows whose runs do not all fit are left
  // out, as is everything below them, and counted.
  void scan(const Bitmap& bitmap, int y_end);

  std::size_t size() const { return counts_.firsts; }
  const Run& operator[](std::size_t i) const { return runs_[i]; }
  std::uint32_t overflow() const { return overflow_; }  // runs left out
  // Rows from the top whose runs are all here, of those that were scanned.
  int rows_searched() const { return rows_searched_; }

 private:
  // So many words at a time: their runs surely fit behind the last.
  static constexpr std::size_t kMaxWords = 256;
  static constexpr std::size_t kSpare = kMaxWords * (Bitmap::kWordBits / 2) + 2;

  void take_back_rows_that_overflow();

  std::array<EndWord, kMaxWords + 1> end_words_{};
  std::array<Run, kCapacity + kSpare> runs_{};
  RunCounts counts_;
  std::uint32_t overflow_ = 0;
  std::size_t words_scanned_ = 0;
  int rows_searched_ = 0;
};

}  // namespace dottrack::image
