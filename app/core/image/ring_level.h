#pragma once
// The level of what lies right around a dot, where other things are near as well.

#include "app/core/image/ring_sums.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Grey levels.
struct RingLevel {
  double middle_dn = 0.0;
  double sigma_dn = 0.0;  // of noise about it
};

// Of the pixels of the rows' outer spans that are not in the inner ones: the shortest interval that
// holds two fifths of them, as if they were the middle of a normal distribution. Up to three fifths
// may be of other things, whatever their grey, as long as they are not all alike. False where there
// are too few pixels to tell.
bool find_level(const ImageView& patch, const PatchRows& rows, RingLevel& level);

}  // namespace dottrack::image
