#pragma once
// What a pixel has to exceed to stand out from its surround: the band relative to the local
// background.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/band_strip.h"
#include "app/core/image/bitmap.h"
#include "app/core/image/identify.h"
#include "app/core/image/tile_rows.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Of each pixel of the searched window that is in band: bright pixels are above it, dark ones
// below. Where no pixel is, it may be anything.
struct Thresholds {
  const std::uint8_t* data = nullptr;  // none where there is no local background
  std::ptrdiff_t stride = 0;
  int rows_above = 0;  // of pixels, between the first row of thresholds and the window

  // It can be read for 64 bytes before and after.
  const std::uint8_t* row(int y) const {
    return data + ((rows_above + y) / kRowsPerThreshold) * stride;
  }
};

// The image is divided into tiles of 8 x 8 pixels from its first pixel on; those at its right and
// lower edge may be smaller. The background in the middle of a tile is the mean, rounded, of the
// pixels of a box of tiles around it, 2 (background_px / 16) + 1 each way, or of the part of that
// box which lies inside the image. From the middles it is interpolated along the rows and then
// along the columns, by averages of two, for 2 x 2 pixels at a time; outside the outermost middles
// it is that of the nearest. So it is the same in every window of an image, and it costs little
// more than the image's sum.
//
// Means that leave out pixels found bright, or replace them by the mean, were tried on real plates
// (dots of 7 px, noise of 6 DN, box of 21 px, contrast of 8 DN): they find no dot that this one
// misses and let through up to half as much clutter again, since leaving out the bright half of
// the noise lowers the mean.
//
// Light scales dots, their surround and the texture of both alike. A contrast that grows with the
// background keeps the texture of what is brightly lit out, and lets dots in the shade in.
class LocalBackground {
 public:
  static constexpr int kRowsAtATime = 2 * kTile_px;

  // The window lies inside the image; min_contrast_dn of the band is at least 1.
  void start(const ImageView& image, const Window& window, const Band& band);
  // Fills the rows of the bitmap before y_end, from where it was, and makes their thresholds; best
  // kRowsAtATime. The bitmap is as large as the window. Returns how many rows are filled: there may
  // be some more. No byte beyond the end of the image's rows is read.
  int fill(int y_end, Bitmap& bitmap);
  // The first row of the image that was not looked at yet; may be behind the last.
  int next_row_px() const { return (middle_ + reach_ + 1) * kTile_px; }

  const Thresholds& thresholds() const { return thresholds_; }

 private:
  static constexpr int kMaxReach = 15;
  static constexpr int kMaxTiles = core::kMaxImageWidth / kTile_px;
  static constexpr int kPad_px = 64;  // vectors run over the end of a row
  static constexpr std::size_t kTiles = kMaxTiles + 2 * kMaxReach + 2 + kPad_px;
  static constexpr std::size_t kRing = 32;  // of rows of tiles: more than any box has
  static constexpr std::size_t kStretched_px = kTiles * kTile_px;
  static constexpr std::ptrdiff_t kStride = core::kMaxImageWidth + 2 * kPad_px;
  static constexpr std::size_t kRowsPerStrip = kStripRows / kRowsPerThreshold;
  static constexpr std::size_t kRows =
      core::kMaxImageHeight / kRowsPerThreshold + 2 * kRowsPerStrip;
  static_assert(kRing > 2 * kMaxReach + 1);

  using TileSums = std::array<std::uint16_t, kTiles>;
  static constexpr std::size_t kPeakRows =
      kMaxReach + 2;  // from the boxes' middle to the last seen
  using Peaks = std::array<std::uint8_t, core::kMaxImageWidth + kPad_px>;
  struct TileRowPeaks {
    Peaks upper;
    Peaks lower;
  };

  int last_tile_row() const { return (image_.height_px - 1) / kTile_px; }
  const std::uint16_t* tiles_of(int row) const;
  TileRowPeaks& peaks_of(int row);
  void look_at_tiles(int row);
  void slide_boxes(int added, int dropped);
  void start_boxes(int row);
  void count_pixels();
  void stretch_means(std::size_t to);
  void fill_strip_of(std::size_t upper, Bitmap& bitmap);

  ImageView image_;
  Window window_;
  Needed needed_ = {};
  int contrast_256ths_ = 0;  // of the background
  int reach_ = 0;            // tiles of a box to each side of its middle
  // Of the tiles whose middles lie around the window, the first and how many; one on each side may
  // be outside the image.
  int first_ = 0;
  int count_ = 0;
  int tile_first_ = 0;  // of those that boxes cover inside the image
  int tile_count_ = 0;
  int strip_ = 0;  // next rows of thresholds: between the middles of this row of tiles and the next
  int middle_ = 0;   // row of tiles of the present boxes
  int rows_px_ = 0;  // in them
  Thresholds thresholds_;
  std::array<TileSums, kRing> tile_sums_{};
  std::array<TileRowPeaks, kPeakRows> peaks_{};
  TileSums nothing_{};  // a row of tiles outside the image
  // Item i belongs to column first_ - reach_ + i of tiles; zero outside the image.
  std::array<std::int32_t, kTiles> column_sums_{};
  // Item i belongs to the box around column first_ + i of tiles.
  std::array<std::int32_t, kTiles> brightest_{};
  std::array<float, kTiles> per_count_{};
  std::array<std::uint8_t, kTiles> means_{};
  // Stretched means of two rows of tiles, the lower of which is the last that was made. A word can
  // be read before them.
  std::array<std::array<std::uint8_t, kPad_px + kStretched_px>, 2> stretched_{};
  std::size_t lower_ = 0;
  std::array<std::uint8_t, kRows* static_cast<std::size_t>(kStride)> values_{};
};

}  // namespace dottrack::image
