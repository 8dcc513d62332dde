#pragma once
// The gates that a component passes to be a dot candidate (paper sections 3.1.2, 3.3).

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "app/core/image/components.h"
#include "app/core/image/identify.h"
#include "app/core/image/moments.h"

namespace dottrack::image {

// What the area and the bounding box alone tell of a gate: whatever the moments of a component that
// they exclude, its area or its semi-major axis is outside the gate.
class SizeBounds {
 public:
  explicit SizeBounds(const RegionGate& gate);

  bool exclude(const Component& component) const {
    const std::int64_t w = component.x_max - component.x_min;
    const std::int64_t h = component.y_max - component.y_min;
    return component.area_px < min_area_px_ || component.area_px > max_area_px_ ||
           std::max(w, h) > max_extent_px_ || w * w + h * h < min_diagonal_squared_;
  }

 private:
  std::int64_t min_area_px_;
  std::int64_t max_area_px_;
  std::int64_t max_extent_px_;  // between the centres of the outermost pixels, as is the diagonal
  std::int64_t min_diagonal_squared_;
};

// By the area and the i-th moments. Which of the bounds a component misses cannot be predicted, so
// all are looked at without a branch.
inline bool passes_size(const RegionGate& gate, int area_px, const Moments& moments,
                        std::size_t i) {
  const bool is_large_enough =
      (area_px >= gate.min_area_px) & (moments.semi_major[i] >= gate.semi_major_min_px);
  return is_large_enough & (moments.semi_major[i] <= gate.semi_major_max_px);
}

inline bool passes_shape(const RegionGate& gate, const Moments& moments, std::size_t i) {
  const bool is_round = moments.semi_minor[i] >= gate.min_axis_ratio * moments.semi_major[i];
  const bool is_full = moments.fill[i] >= gate.min_fill;
  const bool lacks_little = (1.0 - moments.fill[i]) * moments.semi_minor[i] <= gate.max_lack_px;
  const bool fits_box = moments.box_misfit[i] <=
                        gate.max_box_misfit_px + gate.max_box_misfit_part * moments.semi_major[i];
  return is_round & is_full & lacks_little & fits_box;
}

}  // namespace dottrack::image
