#pragma once
// A read-only look at an 8-bit grey image that somebody else owns.

#include <cstddef>
#include <cstdint>

namespace dottrack {

// Pixel (x, y) is column x, row y, 0-based; an integer is the centre of a pixel.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes = 0;  // from one row to the next; at least width_px

  const std::uint8_t* row(int y) const { return data + y * stride_bytes; }
  std::uint8_t at(int x, int y) const { return row(y)[x]; }
  bool empty() const { return data == nullptr || width_px <= 0 || height_px <= 0; }
};

}  // namespace dottrack
