#pragma once
// Whether what is timed against OpenCV does the same work: the same components, the same
// candidates.

#include <string>

#include "app/core/image/identify.h"
#include "hal/base/image_view.h"

namespace dottrack::bench {

// Identify and connectedComponentsWithStats on the picture's in-band pixels: the same components of
// two pixels and more, by place, box, area, centroid and axes, and the same ones pass the gate.
// Returns the first difference, empty if there is none.
std::string opencv_disagrees(const ImageView& image, const image::RegionGate& gate);

}  // namespace dottrack::bench
