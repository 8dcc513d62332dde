#pragma once
// What a region's ellipse says of a dot whose normal is known (paper section 3.3).

#include "app/core/geometry/projected_circle.h"
#include "app/core/image/region.h"

namespace dottrack::estimation {

// What a view counts for that contradicts a dot, at most: a dot may be half hidden.
inline constexpr double kLeastEllipseLogOdds = -4.0;

// A region's own ellipse.
geometry::ImageEllipse ellipse_of(const image::Region& region);

// Whether a region may be the dot that is expected to look like this: both axes and, where the
// ellipse is long enough to have one, the angle. Wide enough for blur, thresholds and a pose that
// is a tick old.
bool may_be(const geometry::ImageEllipse& expected, const geometry::ImageEllipse& seen);

// Natural logarithm of how much more probably a dot that should look like `expected` is seen as
// `seen` than a region of clutter of the same size is: from the axis ratio and the angle alone.
// Between kLeastEllipseLogOdds and 1.6, since a part of all clutter lies as flat as the dots do.
double ellipse_log_odds(const geometry::ImageEllipse& expected, const geometry::ImageEllipse& seen);

}  // namespace dottrack::estimation
