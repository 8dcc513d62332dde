#include "app/core/image/local_background.h"

#include <algorithm>

namespace dottrack::image {

void LocalBackground::start(const ImageView& image, const Window& window, int radius) {
  radius_ = radius;
  x_first_ = std::max(window.x_min - radius, 0);
  x_last_ = std::min(window.x_max + radius, image.width_px - 1);
  column_sum_.fill(0);
  for (int y = std::max(window.y_min - radius, 0);
       y < std::min(window.y_min + radius, image.height_px); ++y) {
    add_row(image, y, 1);
  }
}

void LocalBackground::add_row(const ImageView& image, int y, int sign) {
  const std::uint8_t* pixels = image.row(y);
  for (int x = x_first_; x <= x_last_; ++x) {
    auto& sum = column_sum_[static_cast<std::size_t>(x - x_first_)];
    sum = static_cast<std::uint16_t>(sum + sign * pixels[x]);
  }
}

void LocalBackground::sum_along_row() {
  std::int32_t sum = 0;
  prefix_[0] = 0;
  for (int x = x_first_; x <= x_last_; ++x) {
    const auto i = static_cast<std::size_t>(x - x_first_);
    sum += column_sum_[i];
    prefix_[i + 1] = sum;
  }
}

void LocalBackground::keep_contrast(const ImageView& image, const Window& window, const Band& band,
                                    Bitmap& bitmap) {
  const int radius = std::clamp(band.background_px / 2, 1, kMaxRadius);
  const bool bright = band.polarity == core::Polarity::bright;
  start(image, window, radius);
  for (int y = window.y_min; y <= window.y_max; ++y) {
    if (y + radius < image.height_px) add_row(image, y + radius, 1);
    if (y - radius - 1 >= 0 && y > window.y_min) add_row(image, y - radius - 1, -1);
    sum_along_row();
    const int rows = std::min(y + radius, image.height_px - 1) - std::max(y - radius, 0) + 1;
    for (int x = window.x_min; x <= window.x_max; ++x) {
      const int lo = std::max(x - radius, 0);
      const int hi = std::min(x + radius, image.width_px - 1);
      const std::int32_t sum = prefix_[static_cast<std::size_t>(hi + 1 - x_first_)] -
                               prefix_[static_cast<std::size_t>(lo - x_first_)];
      const std::int32_t count = rows * (hi - lo + 1);
      const std::int32_t difference = image.at(x, y) * count - sum;
      if ((bright ? difference : -difference) < band.min_contrast_dn * count) {
        const int bit = x - window.x_min;
        bitmap.row(y - window.y_min)[bit / 64] &=
            ~(std::uint64_t{1} << static_cast<unsigned>(bit % 64));
      }
    }
  }
}

}  // namespace dottrack::image
