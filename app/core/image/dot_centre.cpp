#include "app/core/image/dot_centre.h"

#include <cmath>

#include "app/core/image/dot_patch.h"
#include "app/core/image/ring_sums.h"

namespace dottrack::image {
namespace {

using Eigen::Vector2d;

constexpr double kGrow_px = 1.25;      // what blur puts outside the region
constexpr double kRingWidth_px = 4.0;  // of the background's ring around that
constexpr double kOutlierSigmas = 2.5;

bool fit_background(const ImageView& patch, const RingMask& mask, GreySums& ring, Plane& plane) {
  if (!fit(ring, plane)) return false;
  drop_outliers(patch, mask, rounded(plane, kOutlierSigmas * plane.sigma + 1.0), ring);
  return fit(ring, plane);
}

// Of the light above the plane, in the patch's coordinates; false when there is next to none.
bool centroid(const GreySums& dot, const Plane& plane, Vector2d& centre) {
  const auto above = [&](std::int64_t v, std::int64_t one, std::int64_t x, std::int64_t y) {
    return static_cast<double>(v) - plane.at_origin * static_cast<double>(one) -
           plane.per_x * static_cast<double>(x) - plane.per_y * static_cast<double>(y);
  };
  const double light = above(dot.v, dot.n, dot.x, dot.y);
  // At least a grey level on average; dark dots give less than no light.
  if (!(std::abs(light) >= static_cast<double>(dot.n)) || dot.n == 0) return false;
  centre =
      Vector2d(above(dot.vx, dot.x, dot.xx, dot.xy), above(dot.vy, dot.y, dot.xy, dot.yy)) / light;
  return true;
}

}  // namespace

Eigen::Vector2d dot_centre(const ImageView& image, const Region& region) {
  if (!(region.semi_major_px + kGrow_px + kRingWidth_px <= kMaxReach_px)) return region.centroid_px;
  const double cosine = std::cos(region.angle_rad);
  const double sine = std::sin(region.angle_rad);
  const GrownEllipse inner(region, cosine, sine, kGrow_px);
  const GrownEllipse outer(region, cosine, sine, kGrow_px + kRingWidth_px);
  const Patch patch = patch_around(image, region.centroid_px, outer);
  if (patch.columns() <= 0 || patch.rows() <= 0) return region.centroid_px;
  const Vector2d corner(patch.x_min, patch.y_min);
  const Vector2d middle = region.centroid_px - corner;
  PatchRows rows;
  rows.count = patch.rows();
  set_spans(outer, middle, patch.rows(), patch.columns(), rows.outer);
  set_spans(inner, middle, patch.rows(), patch.columns(), rows.inner);
  const Pixels pixels(image, patch);
  RingMask mask;
  PatchSums sums = sum_patch(pixels.view(), rows, mask);
  Plane background;
  Vector2d centre;
  if (!fit_background(pixels.view(), mask, sums.ring, background) ||
      !centroid(sums.dot, background, centre) ||
      (centre - middle).norm() > 0.5 * region.semi_minor_px) {
    return region.centroid_px;
  }
  return corner + centre;
}

}  // namespace dottrack::image
