#pragma once
// A dot's centre to a small part of a pixel, measured on the grey values around its region.

#include <Eigen/Core>

#include "app/core/image/region.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// Centroid of the light above (or below) the background over the region grown by the width of its
// blurred edge, the background being a plane fitted to a ring around it, without the ring's
// outliers. A threshold cuts a dot's rim off unevenly and its centroid follows the cut, more so
// where the background slopes; this one does not. Within 1.6 x the Cramer-Rao bound for diameters
// of 6 to 14 px at a contrast of 20 times the noise, and within 0.03 px on a slope of 1 DN a pixel.
//
// The region's own centroid comes back where there is no doing better: too large a dot, too small a
// ring, next to no light, or a centre more than half a semi-minor axis away.
Eigen::Vector2d dot_centre(const ImageView& image, const Region& region);

}  // namespace dottrack::image
