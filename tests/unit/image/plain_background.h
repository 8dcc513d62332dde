#pragma once
// The local background as one would write it without a thought for speed.

#include <vector>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"

namespace dottrack::image::test {

// Of a picture, or of the negative of one with dark dots.
class PlainBackground {
 public:
  PlainBackground(const Picture& picture, const Band& band);

  // By how much a pixel exceeds its background, towards the polarity. Where a contrast relative to
  // the background is more than the absolute one, the background counts as so much brighter.
  int excess(int x, int y) const;
  int at(int x, int y) const;
  // The same without rounding, interpolated in the middle of the pixel's 2 x 2.
  double exact(int x, int y) const;

 private:
  int value(int x, int y) const;
  double mean_around(int tile_x, int tile_y) const;
  double middle(int tile_x, int tile_y) const;
  int raised(double mean) const;

  const Picture& picture_;
  core::Polarity polarity_;
  int contrast_dn_;
  int contrast_256ths_;
  int reach_;
  int columns_;
  int rows_;
  mutable std::vector<double> means_;  // those that were asked for; else below zero
};

}  // namespace dottrack::image::test
