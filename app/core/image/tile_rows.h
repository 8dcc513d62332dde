#pragma once
// The steps from a row of tiles to the thresholds of its pixels, many tiles or pixels at a time.

#include <cstdint>

#include "hal/base/image_view.h"

namespace dottrack::image {

inline constexpr int kTile_px = 8;

// 0xFF turns a pixel of a dark dot into one of a bright dot: value ^ flip.
using Flip = std::uint8_t;

// Of a row of tiles, the furthest value of each column of pixels towards the polarity, flipped for
// dark dots, in the upper and in the lower half of the tiles. Where a tile is cut off by the
// image's edge they are 255: anything might be there.
struct TilePeaks {
  std::uint8_t* upper;
  std::uint8_t* lower;
};

// sums[i] = the sum of all pixels of tile i, and the peaks of its columns. `pixels` is one row of
// tiles: its height is at most kTile_px; its last tile may be narrower.
void sum_tiles(const ImageView& pixels, Flip flip, std::uint16_t* sums, const TilePeaks& peaks);

// sums[i] += added[i] - dropped[i] for n tiles.
void slide_tiles(const std::uint16_t* added, const std::uint16_t* dropped, int n,
                 std::int32_t* sums);

// Boxes of `box` tiles that begin at each of n tiles. Arrays but `means` may be read, and `means`
// written, for 15 tiles beyond the last.
struct TileBoxes {
  const std::int32_t* column_sums;
  int box;
  const std::int32_t* brightest;  // bright: 0; dark: 255 for each of the box's pixels
  const float* per_count;         // the inverse of the pixels in the box
};

// A contrast relative to the background, and by what it is more than an absolute one.
struct RelativeContrast {
  std::int32_t part_256ths;
  std::int32_t absolute_dn;
  Flip flip;  // the background's value is this way round
};

// means[i] = the mean of the box's pixels, flipped for dark dots, rounded to an integer, and raised
// by what the relative contrast asks for beyond the absolute one; at most 255.
void mean_of_boxes(const TileBoxes& boxes, const RelativeContrast& contrast, int n,
                   std::uint8_t* means);

// From means in the middles of tiles to a row of pixels which begins in the middle of the first:
// one, three, five and seven eighths of the way from means[i] to means[i + 1], two pixels each, for
// i < n. May write up to 15 tiles beyond the last.
void stretch(const std::uint8_t* means, int n, std::uint8_t* row);

}  // namespace dottrack::image
