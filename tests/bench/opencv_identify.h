#pragma once
// What OpenCV offers for identify's work: the band, then regions with area, box and moments.

#include <cstddef>

#include "hal/base/image_view.h"

namespace dottrack::bench {

// inRange, findContours (external outlines), moments of each outline. Returns how many outlines.
std::size_t opencv_contours(const ImageView& image);

// inRange, connectedComponentsWithStats (4-connected). Returns how many components.
std::size_t opencv_connected_components(const ImageView& image);

}  // namespace dottrack::bench
