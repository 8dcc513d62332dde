#pragma once
// Which pixels stand out from their surround: the band relative to the local background.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/bitmap.h"
#include "app/core/image/box_row.h"
#include "app/core/image/identify.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// The background of a pixel is the mean of the background_px x background_px box around it, or of
// the part of that box which lies inside the image. The time a pixel does not depend on the box:
// column sums slide down the image, and differences of their running totals are box sums.
//
// Means that leave out pixels found bright, or replace them by the mean, were tried on real plates
// (dots of 7 px, noise of 6 DN, box of 21 px, contrast of 8 DN): they find no dot that this one
// misses and let through up to half as much clutter again, since leaving out the bright half of
// the noise lowers the mean.
class LocalBackground {
 public:
  // Of a bitmap of the window's pixels that lie in the absolute band, keeps those that differ from
  // their background by at least min_contrast_dn (bright: above it; dark: below it), decided in
  // integers.
  void keep_contrast(const ImageView& image, const Window& window, const Band& band,
                     Bitmap& bitmap);

  // By how much each pixel exceeds the contrast it needed, plus one. As large as the window; valid
  // where the bitmap has bits.
  ImageView excess() const { return {excess_.data(), width_px_, height_px_, stride_}; }

 private:
  static constexpr int kMaxRadius = 127;
  static constexpr int kPad = 2 * Bitmap::kWordBits;  // vectors run over the end of a row
  static constexpr std::size_t kRow = core::kMaxImageWidth + 2 * kMaxRadius + 1 + kPad;
  static constexpr std::size_t kPixels =
      static_cast<std::size_t>(core::kMaxImageWidth) * core::kMaxImageHeight;

  void start(const ImageView& image, const Window& window, const Band& band);
  const std::uint8_t* columns_of(const ImageView& image, int y) const;
  void slide_to(const ImageView& image, int y);
  void count_pixels(const ImageView& image, int y);

  Window window_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::ptrdiff_t stride_ = 0;
  int radius_ = 0;
  int x_first_ = 0;  // the image's columns that some box covers
  int x_last_ = 0;
  int rows_ = 0;  // of the present row's boxes inside the image
  Flip flip_ = 0;
  // Column i is column window.x_min - radius + i of the image; its sum is zero outside.
  std::array<std::uint16_t, kRow> column_sums_{};
  std::array<std::int32_t, kRow> totals_{};
  std::array<std::int32_t, kRow> counts_{};
  std::array<float, kRow> per_count_{};
  std::array<std::uint8_t, core::kMaxImageWidth> nothing_{};  // a row outside the image
  std::array<std::uint8_t, kPixels> excess_{};
};

}  // namespace dottrack::image
