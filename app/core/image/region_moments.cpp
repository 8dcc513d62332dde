#include "app/core/image/region_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::image {

namespace {

// Sums over a component's pixels, x and y from the corner of its bounding box.
struct BinarySums {
  std::int64_t x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

struct GreySums {
  std::int64_t i = 0, ix = 0, iy = 0;
  int darkest = 255;
  int brightest = 0;
  int saturated = 0;
};

// A run of n pixels from (x, y) rightwards.
void add_run(BinarySums& sums, std::int64_t x, std::int64_t y, std::int64_t n) {
  const std::int64_t steps = n * (n - 1) / 2;                  // 0 + 1 + ... + (n-1)
  const std::int64_t squares = n * (n - 1) * (2 * n - 1) / 6;  // 0 + 1 + 4 + ...
  const std::int64_t sum_x = n * x + steps;
  sums.x += sum_x;
  sums.y += n * y;
  sums.xx += n * x * x + 2 * x * steps + squares;
  sums.xy += y * sum_x;
  sums.yy += n * y * y;
}

void add_run(GreySums& sums, const std::uint8_t* pixels, int x, int y, int n) {
  int sum = 0;
  int sum_step = 0;
  for (int k = 0; k < n; ++k) {
    const int value = pixels[k];
    sum += value;
    sum_step += value * k;
    sums.darkest = std::min(sums.darkest, value);
    sums.brightest = std::max(sums.brightest, value);
    sums.saturated += value == 255;
  }
  sums.i += sum;
  sums.ix += static_cast<std::int64_t>(sum) * x + sum_step;
  sums.iy += static_cast<std::int64_t>(sum) * y;
}

// The pixel value whose weight in the centroid is one: the threshold that the region rose above.
int base_dn(const GreySums& grey, const Band& band) {
  const bool bright = band.polarity == core::Polarity::bright;
  if (band.min_contrast_dn > 0) return bright ? grey.darkest : grey.brightest;
  return bright ? std::max(band.intensity_min_dn, 0) : std::min(band.intensity_max_dn, 255);
}

// Weight of a pixel: one more than its distance from the base.
Eigen::Vector2d weighted_centroid(const GreySums& grey, const BinarySums& binary, int area,
                                  const Band& band) {
  const std::int64_t base = base_dn(grey, band);
  const std::int64_t sign = band.polarity == core::Polarity::bright ? 1 : -1;
  const std::int64_t offset = 1 - sign * base;
  const auto total = static_cast<double>(sign * grey.i + offset * area);
  return {static_cast<double>(sign * grey.ix + offset * binary.x) / total,
          static_cast<double>(sign * grey.iy + offset * binary.y) / total};
}

// A uniform ellipse has variance a^2/4 along its semi-axis a. A pixel is a unit square: 1/12 each
// way.
void set_ellipse(Region& region, const BinarySums& sums) {
  const double n = region.area_px;
  const double mean_x = static_cast<double>(sums.x) / n;
  const double mean_y = static_cast<double>(sums.y) / n;
  const double xx = static_cast<double>(sums.xx) / n - mean_x * mean_x + 1.0 / 12.0;
  const double xy = static_cast<double>(sums.xy) / n - mean_x * mean_y;
  const double yy = static_cast<double>(sums.yy) / n - mean_y * mean_y + 1.0 / 12.0;
  const double middle = (xx + yy) / 2.0;
  const double half_difference = (xx - yy) / 2.0;
  const double radius = std::sqrt(half_difference * half_difference + xy * xy);
  region.semi_major_px = 2.0 * std::sqrt(middle + radius);
  region.semi_minor_px = 2.0 * std::sqrt(std::max(middle - radius, 1.0 / 12.0));
  region.angle_rad = 0.5 * std::atan2(xy, half_difference);
}

// See Region::core_contrast_dn; at the image's edge, of the pixels that there are.
double core_contrast(const ImageView& image, const Eigen::Vector2d& centroid, int faintest_dn,
                     core::Polarity polarity) {
  const int x = static_cast<int>(centroid.x() + 0.5);
  const int y = static_cast<int>(centroid.y() + 0.5);
  int sum = 0;
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height_px - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width_px - 1); ++i) {
      sum += image.at(i, j);
      ++count;
    }
  }
  const double excess = static_cast<double>(sum) / count - faintest_dn;
  return polarity == core::Polarity::bright ? excess : -excess;
}

bool touches_border(const Component& c, const Window& window, const ImageView&) {
  return c.x_min == 0 || c.y_min == 0 || c.x_max == window.x_max - window.x_min ||
         c.y_max == window.y_max - window.y_min;
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

Region measure(const ImageView& image, const Window& window, const Band& band, const RunList& runs,
               const Components& components, const Component& component) {
  BinarySums binary;
  GreySums grey;
  const int x0 = component.x_min;
  const int y0 = component.y_min;
  for (std::uint32_t i = component.head; i != Components::kEnd; i = components.next_run(i)) {
    const int x = column(runs[i].first);
    const int y = row(runs[i].first);
    const int n = runs[i].last - runs[i].first + 1;
    add_run(binary, x - x0, y - y0, n);
    add_run(grey, image.row(window.y_min + y) + window.x_min + x, x - x0, y - y0, n);
  }
  Region region;
  region.area_px = component.area_px;
  region.saturated_px = grey.saturated;
  region.x_min = static_cast<std::int16_t>(window.x_min + component.x_min);
  region.x_max = static_cast<std::int16_t>(window.x_min + component.x_max);
  region.y_min = static_cast<std::int16_t>(window.y_min + component.y_min);
  region.y_max = static_cast<std::int16_t>(window.y_min + component.y_max);
  region.touches_border = touches_border(component, window, image);
  region.centroid_px = Eigen::Vector2d(region.x_min, region.y_min) +
                       weighted_centroid(grey, binary, region.area_px, band);
  const bool bright = band.polarity == core::Polarity::bright;
  region.core_contrast_dn = core_contrast(
      image, region.centroid_px, bright ? grey.darkest : grey.brightest, band.polarity);
  set_ellipse(region, binary);
  return region;
}

}  // namespace dottrack::image
