#pragma once
// Where components may begin: runs of a bitmap with nothing above them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/image/bitmap.h"
#include "app/core/image/lines_ahead.h"

namespace dottrack::image {

// Each is told by one of its pixels. A run over the end of a word may be listed though something is
// above it.
struct Beginnings {
  static constexpr std::size_t kMaxGroups = 64;  // that are looked through at a time
  static constexpr std::size_t kWords = kMaxGroups * Bitmap::kGroupWords;
  static constexpr std::size_t kMaxLanes = 16;  // so many are followed at once; fewer may wait
  static constexpr std::size_t kSpare = 2;
  static constexpr std::size_t kCapacity =
      kMaxLanes + kWords * (Bitmap::kWordBits / 2) + kSpare + kMaxLanes;

  std::array<PixelKey, kCapacity> pixels{};
  std::size_t size = 0;
  std::array<std::uint64_t, kWords> words{};                        // a bit for each
  std::array<std::uint8_t, kWords + Bitmap::kGroupWords> listed{};  // which of them are not zero
};

// Adds those in some groups of the bitmap's words, at most kMaxGroups, and writes down which pixels
// in them have a 4-neighbour, a group after the other. `ahead` is sent for meanwhile.
void find_beginnings(const Bitmap& bitmap, std::span<const PixelKey> groups,
                     std::uint64_t* connected, LinesAhead& ahead, Beginnings& found);

// The groups in which pixels are left that have a 4-neighbour, by what the former wrote down.
// Returns how many; one more may be written.
std::size_t list_groups_left(const Bitmap& bitmap, std::span<const PixelKey> groups,
                             const std::uint64_t* connected, PixelKey* left);

}  // namespace dottrack::image
