#pragma once
// What a component of pixels looks like as a dot: centroid, ellipse, saturation (paper
// section 3.3).

#include <cstddef>

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/moments.h"
#include "app/core/image/region.h"
#include "app/core/image/region_sums.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// The component as a region of the image; it was found in the window, and its moments are the i-th.
Region region_of(const ImageView& image, const Window& window, core::Polarity polarity,
                 const Component& component, const RegionSums& sums, const Moments& moments,
                 std::size_t i);

}  // namespace dottrack::image
