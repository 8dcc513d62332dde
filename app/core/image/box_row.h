#pragma once
// The steps of a sliding box sum along one row, many pixels at a time.

#include <cstdint>

namespace dottrack::image {

// 0xFF turns a pixel of a dark dot into one of a bright dot: value ^ flip.
using Flip = std::uint8_t;

// sums[i] += (added[i] ^ flip) - (dropped[i] ^ flip) for n columns.
void slide_columns(const std::uint8_t* added, const std::uint8_t* dropped, Flip flip, int n,
                   std::uint16_t* sums);

// totals[i] = sums[0] + ... + sums[i - 1], i from 0 to n.
void running_totals(const std::uint16_t* sums, int n, std::int32_t* totals);

// One row of pixels, each in the middle of its box. All arrays but `pixels` may be read to the end
// of the row's last word.
struct BoxRow {
  const std::uint8_t* pixels;
  int room;  // how many pixels may be read
  Flip flip;
  int contrast_dn;
  const std::int32_t* totals;  // the box of pixel i sums to totals[i + box_px] - totals[i]
  int box_px;
  const std::int32_t* counts;  // pixels in the box
  const float* per_count;      // their inverse
};

// Clears the bits whose pixels do not exceed their box's mean by contrast_dn, exactly:
// (value - contrast) * count < sum. For each word that keeps bits, excess receives
// value - mean - contrast + 1, the mean rounded to an integer: at least 1 where a bit is kept.
void keep_contrast(const BoxRow& row, int words_per_row, std::uint64_t* words,
                   std::uint8_t* excess);

}  // namespace dottrack::image
