#pragma once
// How a camera's pictures lie in memory.

#include <cstddef>
#include <cstdint>

namespace dottrack::drivers {

enum class Packing : std::uint8_t {
  grey,   // one byte a pixel: 8-bit grey, or the luma plane of a planar format
  yuyv,   // every other byte
  mjpeg,  // has to be decoded
};

struct Picture {
  Packing packing = Packing::grey;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes = 0;  // of what the camera writes; 0 for mjpeg

  // What a frame holds at least.
  std::size_t needed_bytes() const {
    if (packing == Packing::mjpeg) return 1;
    const auto row = static_cast<std::size_t>(width_px) * (packing == Packing::yuyv ? 2U : 1U);
    return static_cast<std::size_t>(stride_bytes) * static_cast<std::size_t>(height_px - 1) + row;
  }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
};

}  // namespace dottrack::drivers
