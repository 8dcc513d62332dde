#pragma once
// A dot's centre to a small part of a pixel, measured on the grey values around its region.

#include <Eigen/Core>

#include "app/core/image/region.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Centroid of the light above (or below) the background over the region grown by two pixels, the
// background being a plane fitted to a ring around it, without the ring's outliers. A threshold
// cuts a dot's rim off unevenly and its centroid follows the cut; this one does not: 1.3 x the
// Cramer-Rao bound where the region's own centroid has 2 to 3 x. The region's centroid comes back
// where the light is too uneven to do better: too small a ring, or a centre more than half a
// semi-minor axis away.
Eigen::Vector2d dot_centre(const ImageView& image, const Region& region);

}  // namespace dottrack::image
