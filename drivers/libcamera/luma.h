#pragma once
// The grey of pictures that carry colour. Not for the tick: a decoder allocates.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace dottrack::drivers {

// Rows of a packed 4:2:2 picture, Y0 U Y1 V: every other byte of it. `yuyv` holds
// stride_bytes * (height_px - 1) + 2 * width_px bytes at least, `grey` width_px * height_px.
void copy_yuyv_luma(std::span<const std::uint8_t> yuyv, std::ptrdiff_t stride_bytes, int width_px,
                    int height_px, std::span<std::uint8_t> grey);

// Decodes the luma of JPEG pictures, as a camera sends them (without Huffman tables, say).
class JpegLuma {
 public:
  JpegLuma();
  ~JpegLuma();
  JpegLuma(const JpegLuma&) = delete;
  JpegLuma& operator=(const JpegLuma&) = delete;

  // False when it is not a whole JPEG of that size; `grey` is then undefined.
  bool decode(std::span<const std::uint8_t> jpeg, int width_px, int height_px,
              std::span<std::uint8_t> grey);

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace dottrack::drivers
