#include "app/core/image/local_background.h"

#include <algorithm>

namespace dottrack::image {

namespace {

// The last column (row) of tiles whose middle is not right of (below) a pixel.
int tile_before(int pixel) {
  return (pixel + kTile_px / 2) / kTile_px - 1;
}

int middle_px(int tile) {
  return tile * kTile_px + kTile_px / 2;
}

// How many pixels of an image so long the tiles lie on that are near one.
int covered_px(int tile, int reach, int length_px) {
  return std::min((tile + reach + 1) * kTile_px, length_px) -
         std::max((tile - reach) * kTile_px, 0);
}

Needed needed_by(const Band& band) {
  const bool bright = band.polarity == core::Polarity::bright;
  const int end_dn = bright ? band.intensity_min_dn : 255 - band.intensity_max_dn;
  const int far_end_dn = bright ? band.intensity_max_dn : 255 - band.intensity_min_dn;
  return {static_cast<std::uint8_t>(std::min(band.min_contrast_dn, 256) - 1),
          static_cast<std::uint8_t>(std::max(end_dn - 1, 0)),
          static_cast<std::uint8_t>(std::clamp(far_end_dn, 0, 255)),
          static_cast<Flip>(bright ? 0x00 : 0xFF)};
}

}  // namespace

const std::uint16_t* LocalBackground::tiles_of(int row) const {
  if (row < 0 || row > last_tile_row()) return nothing_.data();
  return tile_sums_[static_cast<std::size_t>(row) % kRing].data();
}

LocalBackground::TileRowPeaks& LocalBackground::peaks_of(int row) {
  const int inside = std::clamp(row, 0, last_tile_row());
  return peaks_[static_cast<std::size_t>(inside) % static_cast<std::size_t>(reach_ + 2)];
}

void LocalBackground::look_at_tiles(int row) {
  const int x = tile_first_ * kTile_px;
  const int y = row * kTile_px;
  const ImageView pixels{image_.row(y) + x, std::min(tile_count_ * kTile_px, image_.width_px - x),
                         std::min(kTile_px, image_.height_px - y), image_.stride_bytes};
  TileRowPeaks& peaks = peaks_of(row);
  sum_tiles(pixels, needed_.flip, tile_sums_[static_cast<std::size_t>(row) % kRing].data(),
            {peaks.upper.data(), peaks.lower.data()});
}

// A row of tiles enters the boxes and another leaves them; either may lie outside the image.
void LocalBackground::slide_boxes(int added, int dropped) {
  if (added >= 0 && added <= last_tile_row()) look_at_tiles(added);
  slide_tiles(tiles_of(added), tiles_of(dropped), tile_count_,
              column_sums_.data() + tile_first_ - (first_ - reach_));
}

void LocalBackground::start(const ImageView& image, const Window& window, const Band& band) {
  image_ = image;
  window_ = window;
  needed_ = needed_by(band);
  contrast_256ths_ = band.min_contrast_256ths;
  reach_ = std::clamp(band.background_px / (2 * kTile_px), 0, kMaxReach);
  first_ = tile_before(window.x_min);
  count_ = tile_before(window.x_max) + 2 - first_;
  tile_first_ = std::max(first_ - reach_, 0);
  const int last = (image.width_px - 1) / kTile_px;
  tile_count_ = std::min(first_ + count_ - 1 + reach_, last) - tile_first_ + 1;
  strip_ = tile_before(window.y_min);
  thresholds_ = {values_.data() + kPad_px, kStride, window.y_min - middle_px(strip_)};
  start_boxes(std::max(strip_, 0));
}

void LocalBackground::start_boxes(int row) {
  std::fill_n(column_sums_.begin(), count_ + 2 * reach_, 0);
  for (int i = row - reach_; i <= row + reach_; ++i) slide_boxes(i, -1);
  rows_px_ = 0;
  middle_ = row;
  lower_ = 0;
  stretch_means(lower_);
}

void LocalBackground::count_pixels() {
  const int rows_px = covered_px(middle_, reach_, image_.height_px);
  if (rows_px == rows_px_) return;
  rows_px_ = rows_px;
  for (int i = 0; i < count_; ++i) {
    // Next to the image there is a column of tiles that may have none.
    const int columns_px = std::max(covered_px(first_ + i, reach_, image_.width_px), 1);
    const int count = rows_px * columns_px;
    brightest_[static_cast<std::size_t>(i)] = needed_.flip * count;
    per_count_[static_cast<std::size_t>(i)] = 1.0F / static_cast<float>(count);
  }
}

void LocalBackground::stretch_means(std::size_t to) {
  count_pixels();
  mean_of_boxes({column_sums_.data(), 2 * reach_ + 1, brightest_.data(), per_count_.data()},
                {contrast_256ths_, needed_.over + 1, needed_.flip}, count_, means_.data());
  if (first_ < 0) means_[0] = means_[1];
  const auto last = static_cast<std::size_t>(count_ - 1);
  if (first_ + count_ - 1 > (image_.width_px - 1) / kTile_px) means_[last] = means_[last - 1];
  stretch(means_.data(), count_ - 1, stretched_[to].data() + kPad_px);
}

// The present strip; `upper`: whose stretched means are those above it.
void LocalBackground::fill_strip_of(std::size_t upper, Bitmap& bitmap) {
  const ImageView pixels{image_.row(window_.y_min) + window_.x_min,
                         window_.x_max - window_.x_min + 1, window_.y_max - window_.y_min + 1,
                         image_.stride_bytes};
  const int from_middle = kPad_px + window_.x_min - middle_px(first_);
  const int from_tile = window_.x_min - tile_first_ * kTile_px;
  const int y = middle_px(strip_) - window_.y_min;
  const int row = (y + thresholds_.rows_above) / kRowsPerThreshold;
  fill_strip({pixels, window_.x_min, y, stretched_[upper].data() + from_middle,
              stretched_[lower_].data() + from_middle, peaks_of(strip_).lower.data() + from_tile,
              peaks_of(strip_ + 1).upper.data() + from_tile,
              values_.data() + kPad_px + row * kStride, kStride},
             needed_, bitmap);
}

int LocalBackground::fill(int y_end, Bitmap& bitmap) {
  for (; middle_px(strip_) < window_.y_min + y_end; ++strip_) {
    const std::size_t upper = lower_;
    if (strip_ >= 0 && strip_ < last_tile_row()) {
      ++middle_;
      slide_boxes(middle_ + reach_, middle_ - reach_ - 1);
      lower_ = 1 - upper;
      stretch_means(lower_);
    }
    fill_strip_of(upper, bitmap);
  }
  return std::min(middle_px(strip_) - window_.y_min, bitmap.height_px());
}

}  // namespace dottrack::image
