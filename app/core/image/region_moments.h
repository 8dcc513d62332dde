#pragma once
// What a component of pixels looks like as a dot: centroid, ellipse, saturation (paper
// section 3.3).

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/region.h"
#include "app/core/image/run_scan.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// The area and the bounding box alone rule the component out: whatever its moments, its area or
// its semi-major axis is outside the gate.
bool excludes_size(const RegionGate& gate, const Component& component);

// The component's pixels, in the coordinates of the window, as a region of the image.
Region measure(const ImageView& image, const Window& window, const Band& band, const RunList& runs,
               const Components& components, const Component& component);

}  // namespace dottrack::image
