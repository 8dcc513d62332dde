#pragma once
// From the local background to the pixels that stand out from it, a strip of rows at a time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/image/bitmap.h"
#include "app/core/image/tile_rows.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

inline constexpr int kStripRows = kTile_px;  // from the middles of a row of tiles to the next
inline constexpr int kRowsPerThreshold = 2;  // two rows of pixels share one

// What a pixel needs. All of it is flipped for dark dots, as pixels are: see Flip.
struct Needed {
  std::uint8_t over;      // more than this above the background
  std::uint8_t floor;     // and more than this
  std::uint8_t furthest;  // and at most this
  Flip flip;
};

// Rows of pixels between the middles of two rows of tiles. Everything begins in the first column of
// the searched window.
struct Strip {
  const ImageView& pixels;          // the searched window; no byte beyond the end of a row is read
  int left_px;                      // of the image, beside the window: what may be read before it
  int y;                            // row of the window in which the strip begins; may be above it
  const std::uint8_t* upper_means;  // the backgrounds along the middles of the tiles, readable for
  const std::uint8_t* lower_means;  // a word before and after
  const std::uint8_t* upper_peaks;  // at least what the pixels of the strip's upper and lower half
  const std::uint8_t* lower_peaks;  // have in each column, readable for a word after
  std::uint8_t* thresholds;  // of the strip's first row, writable for a word before and after
  std::ptrdiff_t stride;
};

// Fills those rows of the bitmap that are in the window, as whoever fills a bitmap has to. The
// thresholds are those which values are counted from; they are made where pixels are in band, and
// may be made elsewhere.
void fill_strip(const Strip& strip, const Needed& needed, Bitmap& bitmap);

}  // namespace dottrack::image
