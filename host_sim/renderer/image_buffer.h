#pragma once
// Pictures that own their pixels, row by row.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"

namespace dottrack::host_sim {

template <class Pixel>
class ImageBuffer {
 public:
  ImageBuffer() = default;
  ImageBuffer(int width_px, int height_px, Pixel fill = {})
      : width_px_(width_px),
        height_px_(height_px),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), fill) {}

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
           static_cast<std::size_t>(x);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<Pixel> pixels_;
};

using GreyImage = ImageBuffer<std::uint8_t>;
using FloatImage = ImageBuffer<float>;

inline ImageView view(const GreyImage& image) {
  return {image.pixels().data(), image.width_px(), image.height_px(), image.width_px()};
}

// A rectangle of pixels; x1 and y1 are one past the last.
struct PixelBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

// `box` grown by `margin_px` on all sides, as far as an image of this size goes.
inline PixelBox grown(const PixelBox& box, int margin_px, int width_px, int height_px) {
  const auto within = [](int v, int high) { return v < 0 ? 0 : (v > high ? high : v); };
  return {within(box.x0 - margin_px, width_px), within(box.y0 - margin_px, height_px),
          within(box.x1 + margin_px, width_px), within(box.y1 + margin_px, height_px)};
}

}  // namespace dottrack::host_sim
