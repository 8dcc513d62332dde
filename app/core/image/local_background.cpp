#include "app/core/image/local_background.h"

#include <algorithm>

namespace dottrack::image {

void LocalBackground::start(const ImageView& image, const Window& window, const Band& band) {
  window_ = window;
  width_px_ = window.x_max - window.x_min + 1;
  height_px_ = window.y_max - window.y_min + 1;
  stride_ = (width_px_ + Bitmap::kWordBits - 1) / Bitmap::kWordBits;
  stride_ *= Bitmap::kWordBits;
  radius_ = std::clamp(band.background_px / 2, 1, kMaxRadius);
  x_first_ = std::max(window.x_min - radius_, 0);
  x_last_ = std::min(window.x_max + radius_, image.width_px - 1);
  rows_ = 0;
  flip_ = band.polarity == core::Polarity::bright ? 0x00 : 0xFF;
  std::fill_n(nothing_.begin(), image.width_px, flip_);
  std::fill_n(column_sums_.begin(), width_px_ + 2 * radius_ + kPad, 0);
  const int x = x_first_ - window.x_min + radius_;
  for (int y = window.y_min - radius_ - 1; y < window.y_min + radius_; ++y) {
    slide_columns(columns_of(image, y), nothing_.data(), flip_, x_last_ - x_first_ + 1,
                  column_sums_.data() + x);
  }
}

const std::uint8_t* LocalBackground::columns_of(const ImageView& image, int y) const {
  return y < 0 || y >= image.height_px ? nothing_.data() : image.row(y) + x_first_;
}

// From the boxes of the row above to those of row y.
void LocalBackground::slide_to(const ImageView& image, int y) {
  const int x = x_first_ - window_.x_min + radius_;
  slide_columns(columns_of(image, y + radius_), columns_of(image, y - radius_ - 1), flip_,
                x_last_ - x_first_ + 1, column_sums_.data() + x);
  running_totals(column_sums_.data(), width_px_ + 2 * radius_, totals_.data());
  count_pixels(image, y);
}

void LocalBackground::count_pixels(const ImageView& image, int y) {
  const int rows = std::min(y + radius_, image.height_px - 1) - std::max(y - radius_, 0) + 1;
  if (rows == rows_) return;
  rows_ = rows;
  for (int i = 0; i < width_px_; ++i) {
    const int x = window_.x_min + i;
    const int columns = std::min(x + radius_, image.width_px - 1) - std::max(x - radius_, 0) + 1;
    counts_[static_cast<std::size_t>(i)] = rows * columns;
    per_count_[static_cast<std::size_t>(i)] = 1.0F / static_cast<float>(rows * columns);
  }
}

namespace {

// Of the words that were listed.
void drop_empty_words(Bitmap& bitmap) {
  const std::span<const PixelKey> listed = bitmap.occupied();
  bitmap.set_occupied_end(listed.data());
  PixelKey* end = bitmap.occupied_end();
  for (const PixelKey key : listed) {
    *end = key;
    end += *bitmap.word(key) != 0;
  }
  bitmap.set_occupied_end(end);
}

}  // namespace

void LocalBackground::keep_contrast(const ImageView& image, const Window& window, const Band& band,
                                    Bitmap& bitmap) {
  start(image, window, band);
  const int contrast_dn = std::min(band.min_contrast_dn, 256);
  for (int y = 0; y < height_px_; ++y) {
    slide_to(image, window.y_min + y);
    const BoxRow row{image.row(window.y_min + y) + window.x_min,
                     image.width_px - window.x_min,
                     flip_,
                     contrast_dn,
                     totals_.data(),
                     2 * radius_ + 1,
                     counts_.data(),
                     per_count_.data()};
    image::keep_contrast(row, bitmap.words_per_row(), bitmap.row(y), excess_.data() + y * stride_);
  }
  drop_empty_words(bitmap);
}

}  // namespace dottrack::image
