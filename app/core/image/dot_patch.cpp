#include "app/core/image/dot_patch.h"

#include <algorithm>
#include <cstring>

namespace dottrack::image {
namespace {

using Eigen::Vector2d;

constexpr std::int64_t kMinRing_px = 12;  // pixels that a plane can be trusted with

}  // namespace

Patch patch_around(const ImageView& image, const Vector2d& centre, const GrownEllipse& outer) {
  return {std::max(static_cast<int>(std::floor(centre.x() - outer.reach_x)), 0),
          std::max(static_cast<int>(std::floor(centre.y() - outer.reach_y)), 0),
          std::min(static_cast<int>(std::ceil(centre.x() + outer.reach_x)), image.width_px - 1),
          std::min(static_cast<int>(std::ceil(centre.y() + outer.reach_y)), image.height_px - 1)};
}

Pixels::Pixels(const ImageView& image, const Patch& patch) {
  view_ = {image.row(patch.y_min) + patch.x_min, patch.columns(), patch.rows(), image.stride_bytes};
  if (patch.x_min + kPatchColumns_px <= image.width_px) return;
  for (int y = 0; y < patch.rows(); ++y) {
    std::memcpy(copy_ + y * kPatchColumns_px, view_.row(y),
                static_cast<std::size_t>(patch.columns()));
  }
  view_.data = copy_;
  view_.stride_bytes = kPatchColumns_px;
}

bool fit(const GreySums& sums, Plane& plane) {
  if (sums.n < kMinRing_px) return false;
  const auto times_n = [&](std::int64_t ab, std::int64_t a, std::int64_t b) {
    return static_cast<double>(sums.n * ab - a * b);
  };
  const double xx = times_n(sums.xx, sums.x, sums.x);
  const double xy = times_n(sums.xy, sums.x, sums.y);
  const double yy = times_n(sums.yy, sums.y, sums.y);
  const double vx = times_n(sums.vx, sums.v, sums.x);
  const double vy = times_n(sums.vy, sums.v, sums.y);
  const double vv = times_n(sums.vv, sums.v, sums.v);
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return false;
  const auto n = static_cast<double>(sums.n);
  plane.per_x = (yy * vx - xy * vy) / determinant;
  plane.per_y = (xx * vy - xy * vx) / determinant;
  plane.at_origin = (static_cast<double>(sums.v) - plane.per_x * static_cast<double>(sums.x) -
                     plane.per_y * static_cast<double>(sums.y)) /
                    n;
  plane.sigma = std::sqrt(std::max(vv - plane.per_x * vx - plane.per_y * vy, 0.0)) / n;
  return true;
}

IntegerPlane rounded(const Plane& plane, double limit_dn) {
  const auto units = [](double dn, double most_dn) {
    return static_cast<std::int32_t>(std::clamp(dn, -most_dn, most_dn) / kPlaneUnit_dn);
  };
  return {units(plane.at_origin, kFar_dn), units(plane.per_x, kSteep_dn),
          units(plane.per_y, kSteep_dn), units(limit_dn, kFar_dn)};
}

}  // namespace dottrack::image
