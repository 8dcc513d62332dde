#pragma once
// How large a dot may look at a distance, and at what distance a region of some size may be
// (paper sections 3.1.2, 3.1.3; size is the semi-major axis, as section 3.3 hopes for).

#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"

namespace dottrack::estimation {

// The smallest and largest dot diameter in question, metres.
struct DiameterRange {
  double min_m = 0.0;
  double max_m = 0.0;
};

struct SemiMajorRange {
  double min_px = 0.0;
  double max_px = 0.0;

  bool contains(double semi_major_px) const {
    return semi_major_px >= min_px && semi_major_px <= max_px;
  }
};

struct RangeWindow {
  double near_m = 0.0;
  double far_m = 0.0;

  bool contains(double range_m) const { return range_m >= near_m && range_m <= far_m; }
  bool empty() const { return !(near_m <= far_m); }
};

// A tilted disc keeps its full diameter along its semi-major axis; blur and a low threshold make it
// look up to half as large again plus a pixel, a dim rim up to a quarter smaller.
SemiMajorRange expected_semi_major(const DiameterRange& diameter, double range_m,
                                   const geometry::AngularScale& scale);

// The distances at which a region of this size passes expected_semi_major, within [near, far].
RangeWindow possible_range(const DiameterRange& diameter, double semi_major_px,
                           const geometry::AngularScale& scale, const RangeWindow& limits);

// The gate for a camera's regions of that size that look like a disc seen at an angle.
image::RegionGate dot_gate(const core::Camera& camera, const SemiMajorRange& size);

}  // namespace dottrack::estimation
