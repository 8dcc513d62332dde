#pragma once
// Sums over the pixels of a component: all that its moments are made of.

#include <cstdint>
#include <span>

#include "app/core/image/components.h"
#include "app/core/image/run_scan.h"
#include "app/core/rig.h"
#include "hal/base/image_view.h"

namespace dottrack::image {

// x and y count from the corner of the component's bounding box. Exact.
struct RegionSums {
  std::int64_t n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // of every pixel
  std::int64_t v = 0, vx = 0, vy = 0;                        // times its value
  std::int64_t saturated = 0;                                // pixels at 255
  int faintest_dn = 0;                                       // bright: darkest; dark: brightest
};

// What the sums are of: `pixels` is the image inside the searched window, `values`, as large, what
// v, vx, vy are of.
struct SumsOf {
  const ImageView& pixels;
  const ImageView& values;
  core::Polarity polarity;
  const RunList& runs;
  const Components& components;
};

// The sums of components[which[i]] to sums[i].
void sum_regions(const SumsOf& of, std::span<const std::uint32_t> which, RegionSums* sums);

}  // namespace dottrack::image
