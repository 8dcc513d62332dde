#include "app/core/image/gates.h"

#include <algorithm>
#include <numbers>

namespace dottrack::image {

namespace {

// Area over the area of the ellipse with the same moments: 1 for an ellipse, less for all else.
double fill(const Region& region) {
  return region.area_px / (std::numbers::pi * region.semi_major_px * region.semi_minor_px);
}

}  // namespace

bool excludes_size(const RegionGate& gate, const Component& component) {
  const double area = component.area_px;
  const double w = component.x_max - component.x_min + 1;
  const double h = component.y_max - component.y_min + 1;
  if (component.area_px < gate.min_area_px) return true;
  // Of all shapes of this area the disc has the least major axis.
  const double max_squared = gate.semi_major_max_px * gate.semi_major_max_px;
  if (area > std::numbers::pi * max_squared) return true;
  // A connected region has a pixel in each of its columns: sum (x - mean)^2 >= w (w^2 - 1) / 12.
  const double longest = std::max(w, h);
  if (longest * (longest * longest - 1.0) + area > 3.0 * area * max_squared) return true;
  // A variance is at most a quarter of the extent squared.
  const double min_squared = gate.semi_major_min_px * gate.semi_major_min_px;
  return (w - 1.0) * (w - 1.0) + (h - 1.0) * (h - 1.0) + 1.0 / 3.0 < min_squared;
}

bool passes_size(const RegionGate& gate, const Region& region) {
  return region.area_px >= gate.min_area_px && region.semi_major_px >= gate.semi_major_min_px &&
         region.semi_major_px <= gate.semi_major_max_px;
}

bool passes_shape(const RegionGate& gate, const Region& region) {
  return region.semi_minor_px >= gate.min_axis_ratio * region.semi_major_px &&
         fill(region) >= gate.min_fill && region.core_contrast_dn >= gate.min_core_contrast_dn;
}

}  // namespace dottrack::image
