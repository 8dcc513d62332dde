#include "app/core/image/bitmap.h"

#include <algorithm>

namespace dottrack::image {

void Bitmap::reshape(int width_px, int height_px) {
  width_px_ = width_px;
  height_px_ = height_px;
  words_per_row_ = (width_px + kWordBits - 1) / kWordBits;
  occupied_count_ = 0;
  std::fill_n(row(-1), words_per_row_ + kGroupWords, 0U);
  std::fill_n(row(height_px), words_per_row_ + kGroupWords, 0U);
}

}  // namespace dottrack::image
