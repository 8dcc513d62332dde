#include "app/core/image/bitmap.h"

#include <algorithm>

namespace dottrack::image {

void Bitmap::reshape(int width_px, int height_px) {
  width_px_ = width_px;
  height_px_ = height_px;
  words_per_row_ = (width_px + kWordBits - 1) / kWordBits;
  occupied_count_ = 0;
  words_[0] = 0;
  std::fill_n(row(-1), words_per_row_ + 1, 0U);
  for (int y = 0; y < height_px; ++y) row(y)[words_per_row_] = 0;
  std::fill_n(row(height_px), words_per_row_ + 1, 0U);
}

std::uint64_t Bitmap::last_word_mask() const {
  const int used = width_px_ % kWordBits;
  return used == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << static_cast<unsigned>(used)) - 1;
}

}  // namespace dottrack::image
