#pragma once
// Components that fill a box of 8 x 8 pixels at most, taken out of a bitmap before it is divided
// into runs: most of what is in a picture, and most dots.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/image/beginnings.h"
#include "app/core/image/bitmap.h"
#include "app/core/image/lines_ahead.h"

namespace dottrack::image {

struct SmallComponent {
  static constexpr int kSide_px = 8;

  std::uint64_t bits;  // of the box from its corner, eight a row
  PixelKey first;      // its first pixel
  std::int16_t x_min;
  std::int16_t y_min;
  std::uint8_t width_px;  // of the bounding box
  std::uint8_t height_px;
  std::uint8_t area_px;
};

// Of these components every row is one run: one with a gap in a row is left in the bitmap, as is a
// larger one. Each is followed downwards from its first run, several side by side.
class SmallComponents {
 public:
  static constexpr std::size_t kCapacity = 65536;  // more are left in the bitmap

  void clear();
  // Looks for beginnings in the rows that the bitmap has more than at the last call, before row
  // y_end, and follows as many as fill its lanes. The rows before y_end + kSide_px are filled, or
  // all there are. What is taken is cleared in the bitmap. `ahead` is sent for meanwhile.
  void take(Bitmap& bitmap, int y_end, LinesAhead ahead);
  // Follows what is left; then the components are complete.
  void finish(Bitmap& bitmap);
  // Forgets those that begin in row y or below.
  void drop_from(int y);

  // In the order of their first pixels.
  std::size_t size() const { return size_; }
  const SmallComponent& operator[](std::size_t i) const { return components_[i]; }

  // First pixels of the groups of words in which finish() left pixels with a 4-neighbour, row by
  // row.
  std::span<const PixelKey> groups_left() const { return {left_.data(), left_count_}; }

 private:
  // In the groups from where it was to `group_end`, in which nothing more will be taken.
  void list_left(const Bitmap& bitmap, std::size_t group_end);

  std::array<SmallComponent, kCapacity + Beginnings::kMaxLanes> components_{};
  std::size_t size_ = 0;
  Beginnings beginnings_;
  std::size_t groups_taken_ = 0;
  std::size_t groups_listed_ = 0;
  // Of the occupied groups: the pixels that had a 4-neighbour.
  std::array<std::uint64_t, Bitmap::kMaxGroups * Bitmap::kGroupWords> connected_{};
  std::array<PixelKey, Bitmap::kMaxGroups + 1> left_{};
  std::size_t left_count_ = 0;
};

}  // namespace dottrack::image
