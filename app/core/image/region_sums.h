#pragma once
// Sums over the pixels of a component: all that its moments are made of.

#include <cstdint>

#include "app/core/image/components.h"
#include "app/core/image/run_scan.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// How much a pixel counts in its region's centroid: sign * value + offset, at least 1.
struct PixelWeights {
  ImageView values;  // as large as the window that was searched
  int sign = 1;
  int offset = 0;
};

// x and y count from the corner of the component's bounding box. Exact.
struct RegionSums {
  std::int64_t n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // of every pixel
  std::int64_t v = 0, vx = 0, vy = 0;                        // times its value
  std::int64_t saturated = 0;                                // pixels at 255
  int darkest = 255;                                         // pixel
  int brightest = 0;
};

// `pixels` is the image inside the searched window, `values` what the sums v, vx, vy are of.
RegionSums sum_region(const ImageView& pixels, const ImageView& values, const RunList& runs,
                      const Components& components, const Component& component);

}  // namespace dottrack::image
