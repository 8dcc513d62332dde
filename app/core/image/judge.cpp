#include "app/core/image/judge.h"

#include <algorithm>

#include "app/core/image/gates.h"

namespace dottrack::image {

namespace {

// Mean of the 3 x 3 pixels around a pixel; at the image's edge, of those that there are.
double mean_at_edge(const ImageView& image, int x, int y) {
  int sum = 0;
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height_px - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width_px - 1); ++i) {
      sum += image.row(j)[i];
      ++count;
    }
  }
  return static_cast<double>(sum) / count;
}

double mean_around(const ImageView& image, int x, int y) {
  if (x < 1 || y < 1 || x > image.width_px - 2 || y > image.height_px - 2) [[unlikely]] {
    return mean_at_edge(image, x, y);
  }
  const std::uint8_t* p = image.row(y) + x;
  const std::uint8_t* up = p - image.stride_bytes;
  const std::uint8_t* down = p + image.stride_bytes;
  const int sum = up[-1] + up[0] + up[1] + p[-1] + p[0] + p[1] + down[-1] + down[0] + down[1];
  return sum / 9.0;
}

// Coordinates in an image are never negative, and lround would be a call.
int nearest_pixel(double coordinate) {
  return static_cast<int>(coordinate + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

// See Region::core_contrast_dn.
double core_contrast(const ImageView& image, const Eigen::Vector2d& centroid_px, int faintest_dn,
                     core::Polarity polarity) {
  const double middle =
      mean_around(image, nearest_pixel(centroid_px.x()), nearest_pixel(centroid_px.y()));
  return polarity == core::Polarity::bright ? middle - faintest_dn : faintest_dn - middle;
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

void set_ellipse(Region& region, const Moments& moments, std::size_t i) {
  region.semi_major_px = moments.semi_major[i];
  region.semi_minor_px = moments.semi_minor[i];
  region.angle_rad = moments.angle_rad[i];
  region.box_misfit_px = moments.box_misfit[i];
}

// In the image, of the weighted pixels.
Eigen::Vector2d centroid_of(const Candidates& of, const Component& component, std::size_t i) {
  const Eigen::Vector2d corner(of.window.x_min + component.x_min,
                               of.window.y_min + component.y_min);
  if (of.sums[i].has_values) return corner + Eigen::Vector2d(of.moments.x[i], of.moments.y[i]);
  sum_values(of.of, component, of.sums[i]);
  return corner + centroid(of.sums[i], of.weights);
}

void judge_one(const Candidates& of, const RegionGate& gate, std::size_t i, Regions& regions,
               IdentifyCounts& counts) {
  const Component& component = of.all[i].component;
  if (!passes_size(gate, component.area_px, of.moments, i)) {
    ++counts.rejected_size;
    return;
  }
  if (!passes_shape(gate, of.moments, i)) {
    ++counts.rejected_shape;
    return;
  }
  const Eigen::Vector2d centroid_px = centroid_of(of, component, i);
  const RegionSums& sums = of.sums[i];
  const double contrast_dn = core_contrast(of.image, centroid_px, sums.faintest_dn, of.of.polarity);
  if (contrast_dn < gate.min_core_contrast_dn) {
    ++counts.rejected_shape;
    return;
  }
  if (regions.size() == regions.capacity()) {
    ++counts.overflow_regions;
    return;
  }
  Region& region = regions.emplace_back();
  set_box(region, component, of.window);
  set_ellipse(region, of.moments, i);
  region.centroid_px = centroid_px;
  region.core_contrast_dn = contrast_dn;
  region.saturated_px = static_cast<int>(sums.saturated_px);
  ++counts.accepted;
}

}  // namespace

void judge(const Candidates& candidates, const RegionGate& gate, Regions& regions,
           IdentifyCounts& counts) {
  for (std::size_t i = 0; i < candidates.all.size(); ++i) {
    judge_one(candidates, gate, i, regions, counts);
  }
}

}  // namespace dottrack::image
