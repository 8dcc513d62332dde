#pragma once
// One bit a pixel: what is left of an image, or of a window of it, after a threshold.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/limits.h"

namespace dottrack::image {

// A pixel as one number: row * kRowStep + column. Pixels of neighbouring rows compare by plain
// addition.
using PixelKey = std::int32_t;
inline constexpr PixelKey kRowStep = 1 << 16;
constexpr int column(PixelKey key) {
  return key & (kRowStep - 1);
}
constexpr int row(PixelKey key) {
  return key / kRowStep;
}

// Pixel (x, y) is bit x % 64 of word x / 64 in row y. Around the pixels lies a border of zeros: the
// word before and the word after each row, the row above the first and the row below the last, so
// that neighbours can be read without asking whether they exist. Whoever fills the rows also lists
// the words that are not zero.
class Bitmap {
 public:
  static constexpr int kWordBits = 64;
  static constexpr int kMaxRowWords = (core::kMaxImageWidth + kWordBits - 1) / kWordBits;

  // The words of the rows keep what they held; the border is cleared.
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

  // The bits of a row's last word that are pixels.
  std::uint64_t last_word_mask() const;

  // First pixels of the words that are not zero, row by row.
  std::span<const PixelKey> occupied() const { return {occupied_.data(), occupied_count_}; }
  // Where to list them; the list ends where it is told to end.
  PixelKey* occupied_begin() { return occupied_.data(); }
  PixelKey* occupied_end() { return occupied_.data() + occupied_count_; }
  void set_occupied_end(const PixelKey* end) {
    occupied_count_ = static_cast<std::size_t>(end - occupied_.data());
  }

 private:
  std::size_t offset(int y) const {
    return 1 + static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(words_per_row_ + 1);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  int words_per_row_ = 0;
  static constexpr std::size_t kCapacity =
      1 + static_cast<std::size_t>(kMaxRowWords + 1) * (core::kMaxImageHeight + 2);
  std::array<std::uint64_t, kCapacity> words_{};
  std::array<PixelKey, static_cast<std::size_t>(kMaxRowWords) * core::kMaxImageHeight + 1>
      occupied_{};
  std::size_t occupied_count_ = 0;
};

}  // namespace dottrack::image
