#pragma once
// Which pixels stand out from their surround: the band relative to the local background.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/bitmap.h"
#include "app/core/image/identify.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// The background of a pixel is the mean of the background_px x background_px box around it, or of
// the part of that box which lies inside the image. The time a pixel does not depend on the box.
class LocalBackground {
 public:
  // Clears the bits of pixels that differ from their background by less than min_contrast_dn
  // (bright: above it; dark: below it). Exact: all in integers.
  void keep_contrast(const ImageView& image, const Window& window, const Band& band,
                     Bitmap& bitmap);

 private:
  static constexpr int kMaxRadius = 127;
  static constexpr std::size_t kRow = core::kMaxImageWidth + 2 * kMaxRadius + 64;

  void start(const ImageView& image, const Window& window, int radius);
  void add_row(const ImageView& image, int y, int sign);
  void sum_along_row();

  int radius_ = 0;
  int x_first_ = 0;  // the columns that some box of the window reaches
  int x_last_ = 0;
  int x_shift_ = 0;                               // of column x in the arrays below
  std::array<std::uint16_t, kRow> column_sum_{};  // of the box's rows: at most 255 * 255
  std::array<std::int32_t, kRow> prefix_{};       // sums of column_sum_ from the left
  std::array<std::int32_t, kRow> columns_{};      // how many columns the box of a pixel has
};

}  // namespace dottrack::image
