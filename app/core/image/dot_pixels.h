#pragma once
// A dot's pixels in a list, for sums that take some at a time.

#include <algorithm>
#include <array>
#include <cstddef>

#include "app/core/image/ring_sums.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// A dot's pixels, one after the other, in the patch's coordinates.
struct DotPixels {
  static constexpr int kCapacity = 2368;
  static constexpr int kBlock = 8;  // that many are worked on at a time
  static constexpr float kFar_px = 200.0F;

  int count = 0;
  std::array<float, kCapacity + kBlock> x;
  std::array<float, kCapacity + kBlock> y;
  std::array<float, kCapacity + kBlock> grey;

  // After the last pixel: what is read behind it is outside of every dot, but not so far that the
  // little of a dot that is left there counts, times the square of the distance.
  void close() {
    const auto end = static_cast<std::ptrdiff_t>(count);
    std::fill_n(x.begin() + end, kBlock, kFar_px);
    std::fill_n(y.begin() + end, kBlock, 0.0F);
    std::fill_n(grey.begin() + end, kBlock, 0.0F);
  }
};

// The pixels of the rows' inner spans. False when there is no room for them.
bool list_pixels(const ImageView& patch, const PatchRows& rows, DotPixels& pixels);
// A map's pixels: some of those.
void list_pixels(const ImageView& patch, const PixelMap& map, DotPixels& pixels);

}  // namespace dottrack::image
