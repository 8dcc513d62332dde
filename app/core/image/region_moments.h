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

// See Region::core_contrast_dn; `faintest_dn` is of the region's pixels.
double core_contrast(const ImageView& image, const Eigen::Vector2d& centroid_px, int faintest_dn,
                     core::Polarity polarity);

// Box, area and ellipse of a component that was found in the window; its moments are the i-th.
void set_region(const Window& window, const Component& component, const Moments& moments,
                std::size_t i, Region& region);

}  // namespace dottrack::image
