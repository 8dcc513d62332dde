#pragma once
// What a region's ellipse says of a dot whose normal is known (paper section 3.3).

#include "app/core/geometry/projected_circle.h"
#include "app/core/image/region.h"

namespace dottrack::estimation {

// A region's own ellipse.
geometry::ImageEllipse ellipse_of(const image::Region& region);

// Whether a region may be the dot that is expected to look like this: both axes and, where the
// ellipse is long enough to have one, the angle. Wide enough for blur, thresholds and a pose that
// is a tick old.
bool may_be(const geometry::ImageEllipse& expected, const geometry::ImageEllipse& seen);

// Natural logarithm of how much more probably a dot that should look like `expected` is seen as
// `seen` than a region of clutter is. Bounded below: a dot may be half hidden.
double ellipse_log_odds(const geometry::ImageEllipse& expected, const geometry::ImageEllipse& seen);

}  // namespace dottrack::estimation
