#pragma once
// One bit a pixel: what is left of an image, or of a window of it, after a threshold.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/limits.h"

namespace dottrack::image {

// A pixel as one number, row * kRowStep + column: pixels of neighbouring rows compare by plain
// addition.
using PixelKey = std::int32_t;
inline constexpr PixelKey kRowStep = 4096;
constexpr int column(PixelKey key) {
  return key & (kRowStep - 1);
}
constexpr int row(PixelKey key) {
  return key >> 12;
}

// Pixel (x, y) is bit x % 64 of word x / 64 in row y. Around the pixels lies a border of zeros: the
// word before and the word after each row, the row above the first and the row below the last, so
// that neighbours can be read without asking whether they exist. Words count in groups of a few
// from the beginning of a row; whoever fills rows clears the words after each, up to the end of a
// group and one at least, and lists the groups that are not zero.
class Bitmap {
 public:
  static constexpr int kWordBits = 64;
  static constexpr int kGroupWords = 4;
  static constexpr int kRowWords = kRowStep / kWordBits;  // from one row to the next
  static constexpr std::size_t kMaxGroups =
      static_cast<std::size_t>((core::kMaxImageWidth + kWordBits * kGroupWords - 1) /
                               (kWordBits * kGroupWords)) *
      core::kMaxImageHeight;

  // Forgets what was listed and clears the rows above and below; the rows are left to be filled.
  void reshape(int width_px, int height_px);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int words_per_row() const { return words_per_row_; }

  // y from -1 to height_px().
  std::uint64_t* row(int y) { return words_.data() + offset(y); }
  const std::uint64_t* row(int y) const { return words_.data() + offset(y); }
  bool at(int x, int y) const {
    return ((row(y)[x / kWordBits] >> static_cast<unsigned>(x % kWordBits)) & 1U) != 0;
  }

  // The word that begins with this pixel.
  const std::uint64_t* word(PixelKey key) const { return row(0) + (key >> 6); }
  std::uint64_t* word(PixelKey key) { return row(0) + (key >> 6); }

  // First pixels of the groups that are not zero, row by row.
  std::span<const PixelKey> occupied() const { return {occupied_.data(), occupied_count_}; }
  // How many of these lie above row y, which is filled or the next to be.
  std::size_t groups_before(int y) const { return y > 0 ? groups_to_[row_index(y - 1)] : 0; }
  // To list more: where the list ends, and where it ends after row y.
  PixelKey* occupied_end() { return occupied_.data() + occupied_count_; }
  void set_occupied_end(int y, const PixelKey* end) {
    occupied_count_ = static_cast<std::size_t>(end - occupied_.data());
    groups_to_[row_index(y)] = static_cast<std::uint32_t>(occupied_count_);
  }

 private:
  static_assert(core::kMaxImageWidth + (kGroupWords + 1) * kWordBits <= kRowStep);

  static std::size_t row_index(int y) { return static_cast<std::size_t>(y); }
  static std::size_t offset(int y) {
    return 1 + static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(kRowWords);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  int words_per_row_ = 0;
  std::size_t occupied_count_ = 0;
  static constexpr int kRowsBeyond = 8;  // who looks for the end of something may look so far
  std::array<std::uint64_t,
             1 + static_cast<std::size_t>(kRowWords) * (core::kMaxImageHeight + 2 + kRowsBeyond)>
      words_{};
  std::array<PixelKey, kMaxGroups + 1> occupied_{};
  std::array<std::uint32_t, core::kMaxImageHeight> groups_to_{};  // down to each row
};

}  // namespace dottrack::image
