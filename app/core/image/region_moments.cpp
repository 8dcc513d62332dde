#include "app/core/image/region_moments.h"

#include <algorithm>
#include <cmath>

#include "app/core/image/arc_tangent.h"

namespace dottrack::image {

namespace {

void set_centroid(Region& region, const RegionSums& sums, const PixelWeights& weights) {
  const std::int64_t sign = weights.sign;
  const std::int64_t offset = weights.offset;
  const double per_weight = 1.0 / static_cast<double>(sign * sums.v + offset * sums.n);
  const auto x = static_cast<double>(sign * sums.vx + offset * sums.x);
  const auto y = static_cast<double>(sign * sums.vy + offset * sums.y);
  region.centroid_px = {region.x_min + x * per_weight, region.y_min + y * per_weight};
}

// A uniform ellipse has variance a^2 / 4 along its semi-axis a; a pixel is a unit square, which
// adds 1/12 each way.
void set_ellipse(Region& region, const RegionSums& sums) {
  const double per_pixel = 1.0 / static_cast<double>(sums.n);
  const double x = static_cast<double>(sums.x) * per_pixel;
  const double y = static_cast<double>(sums.y) * per_pixel;
  const double xx = static_cast<double>(sums.xx) * per_pixel - x * x;
  const double xy = static_cast<double>(sums.xy) * per_pixel - x * y;
  const double yy = static_cast<double>(sums.yy) * per_pixel - y * y;
  const double middle = 0.5 * (xx + yy);
  const double half_difference = 0.5 * (xx - yy);
  const double radius = std::sqrt(half_difference * half_difference + xy * xy);
  region.semi_major_px = 2.0 * std::sqrt(middle + radius + 1.0 / 12.0);
  region.semi_minor_px = 2.0 * std::sqrt(std::max(middle - radius, 0.0) + 1.0 / 12.0);
  region.angle_rad = 0.5 * arc_tangent(xy, half_difference);
}

void set_box(Region& region, const Component& component, const Window& window) {
  region.area_px = component.area_px;
  region.x_min = static_cast<std::int16_t>(window.x_min + component.x_min);
  region.x_max = static_cast<std::int16_t>(window.x_min + component.x_max);
  region.y_min = static_cast<std::int16_t>(window.y_min + component.y_min);
  region.y_max = static_cast<std::int16_t>(window.y_min + component.y_max);
  region.touches_border = region.x_min == window.x_min || region.x_max == window.x_max ||
                          region.y_min == window.y_min || region.y_max == window.y_max;
}

// Mean of the 3 x 3 pixels around a pixel; at the image's edge, of those that there are.
double mean_around(const ImageView& image, int x, int y) {
  const int x_min = std::max(x - 1, 0);
  const int x_max = std::min(x + 1, image.width_px - 1);
  const int y_min = std::max(y - 1, 0);
  const int y_max = std::min(y + 1, image.height_px - 1);
  const int columns = x_max - x_min + 1;
  const int rows = y_max - y_min + 1;
  int sum = 0;
  for (int j = y_min; j <= y_max; ++j) {
    const std::uint8_t* pixels = image.row(j) + x_min;
    sum += pixels[0] + (columns > 1 ? pixels[1] : 0) + (columns > 2 ? pixels[2] : 0);
  }
  return static_cast<double>(sum) / (rows * columns);
}

// Coordinates in an image are never negative, and lround would be a call.
int nearest_pixel(double coordinate) {
  return static_cast<int>(coordinate + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

// See Region::core_contrast_dn.
double core_contrast(const ImageView& image, const Eigen::Vector2d& centroid, int faintest_dn,
                     core::Polarity polarity) {
  const double middle =
      mean_around(image, nearest_pixel(centroid.x()), nearest_pixel(centroid.y()));
  return polarity == core::Polarity::bright ? middle - faintest_dn : faintest_dn - middle;
}

}  // namespace

Region region_of(const ImageView& image, const Window& window, core::Polarity polarity,
                 const PixelWeights& weights, const Component& component, const RegionSums& sums) {
  Region region;
  set_box(region, component, window);
  region.saturated_px = static_cast<int>(sums.saturated);
  set_centroid(region, sums, weights);
  set_ellipse(region, sums);
  const bool bright = polarity == core::Polarity::bright;
  region.core_contrast_dn =
      core_contrast(image, region.centroid_px, bright ? sums.darkest : sums.brightest, polarity);
  return region;
}

}  // namespace dottrack::image
