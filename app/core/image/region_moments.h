#pragma once
// What a component of pixels looks like as a dot: centroid, ellipse, saturation (paper
// section 3.3).

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/region.h"
#include "app/core/image/region_sums.h"
#include "app/core/image/run_scan.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// The area and the bounding box alone rule the component out: whatever its moments, its area or
// its semi-major axis is outside the gate.
bool excludes_size(const RegionGate& gate, const Component& component);

// The component as a region of the image, found in the window.
Region measure(const ImageView& image, const Window& window, core::Polarity polarity,
               const PixelWeights& weights, const RunList& runs, const Components& components,
               const Component& component);

// The pixels of the image inside the window.
ImageView inside(const ImageView& image, const Window& window);

}  // namespace dottrack::image
