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

std::size_t Bitmap::groups_before(int y, std::size_t at_least) const {
  const auto groups = occupied();
  const auto from = groups.begin() + static_cast<std::ptrdiff_t>(at_least);
  const auto stop = std::lower_bound(from, groups.end(), y * kRowStep);
  return static_cast<std::size_t>(stop - groups.begin());
}

}  // namespace dottrack::image
