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

// A run may have begun in one word and end in another.
struct RunCounts {
  std::size_t firsts = 0;
  std::size_t lasts = 0;
};

// The ends of runs, some groups of words at a time.
struct EndWords {
  static constexpr std::size_t kMaxGroups = 64;
  static constexpr std::size_t kMaxWords = kMaxGroups * Bitmap::kGroupWords;

  // Of each word: one bit for the first and for the last pixel of each run.
  std::array<std::uint64_t, kMaxWords> first{};
  std::array<std::uint64_t, kMaxWords> last{};
  // Which of the words have runs.
  std::array<std::uint8_t, kMaxWords + Bitmap::kGroupWords> listed{};
};

class RunList {
 public:
  static constexpr std::size_t kCapacity = 131072;

  // The runs of all the bitmap's rows, leaving out pixels without a 4-neighbour. `listed`: first
  // pixels of the groups of words that are not zero. Rows whose runs do not all fit are left out,
  // as is everything below them, and counted.
  void scan(const Bitmap& bitmap, std::span<const PixelKey> listed);

  std::size_t size() const { return counts_.firsts; }
  const Run& operator[](std::size_t i) const { return runs_[i]; }
  std::uint32_t overflow() const { return overflow_; }  // runs left out
  // Rows from the top whose runs are all here.
  int rows_searched() const { return rows_searched_; }

 private:
  // The runs of the words that are sought at a time surely fit behind the last.
  static constexpr std::size_t kSpare = EndWords::kMaxWords * (Bitmap::kWordBits / 2) + 2;

  void take_back_rows_that_overflow();

  EndWords ends_;
  std::array<Run, kCapacity + kSpare> runs_{};
  RunCounts counts_;
  std::uint32_t overflow_ = 0;
  int rows_searched_ = 0;
};

}  // namespace dottrack::image
