#pragma once
// From the sums over components' pixels to centroids and ellipses, several components at a time.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/image/region_sums.h"

namespace dottrack::image {

// How much a pixel counts in its region's centroid: sign * value + offset, at least 1.
struct PixelWeights {
  int sign = 1;
  int offset = 0;
};

// Of a few components: lengths in pixels; x and y count from the corner of the bounding box.
struct Moments {
  static constexpr std::size_t kCapacity = 32;
  using Column = std::array<double, kCapacity>;

  Column x, y;  // centroid of the weighted pixels, if the sums have values
  Column semi_major, semi_minor, angle_rad;
  Column fill;        // area over that of the ellipse: 1 for an ellipse, less for all else
  Column box_misfit;  // see Region::box_misfit_px
};

// Centroid of the weighted pixels of one component with values, as measure() has it.
Eigen::Vector2d centroid(const RegionSums& sums, const PixelWeights& weights);

// A uniform ellipse has variance a^2 / 4 along its semi-axis a; a pixel is a unit square, which
// adds 1/12 each way. At most kCapacity sums.
void measure(std::span<const RegionSums> sums, const PixelWeights& weights, Moments& moments);

}  // namespace dottrack::image
