#include "app/core/image/region_moments.h"

#include <algorithm>

namespace dottrack::image {

namespace {

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
                 const Component& component, const RegionSums& sums, const Moments& moments,
                 std::size_t i) {
  Region region;
  set_box(region, component, window);
  region.saturated_px = static_cast<int>(sums.saturated);
  region.centroid_px = {region.x_min + moments.x[i], region.y_min + moments.y[i]};
  region.semi_major_px = moments.semi_major[i];
  region.semi_minor_px = moments.semi_minor[i];
  region.angle_rad = moments.angle_rad[i];
  region.core_contrast_dn = core_contrast(image, region.centroid_px, sums.faintest_dn, polarity);
  return region;
}

}  // namespace dottrack::image
