#include "app/core/acquisition/ray_arrays.h"

#include <algorithm>
#include <cmath>

namespace dottrack::acquisition {
namespace {

using estimation::Sighting;

constexpr double kLeastNear_m = 1e-6;  // so that it can be divided by

double box_tangent(const Sighting& sighting, double max_residual_px) {
  const auto& jacobian = sighting.pixels_per_rad;
  const Eigen::Vector2d along = jacobian * sighting.line.ray.direction;  // nearly zero
  const Eigen::Vector2d corner = (sighting.box_max_px - sighting.pixel)
                                     .cwiseAbs()
                                     .cwiseMax((sighting.box_min_px - sighting.pixel).cwiseAbs());
  const double in_box2_px = (corner + along.cwiseAbs()).squaredNorm();
  const double residual_px = max_residual_px + along.cwiseAbs().sum();
  const double reach2_px = std::min(in_box2_px, residual_px * residual_px);
  // The smaller eigenvalue of J J^T for displacements across the ray: the slowest that the pixel
  // moves, squared.
  const double xx = jacobian.row(0).squaredNorm() - along.x() * along.x();
  const double yy = jacobian.row(1).squaredNorm() - along.y() * along.y();
  const double xy = jacobian.row(0).dot(jacobian.row(1)) - along.x() * along.y();
  const double half_gap = 0.5 * (xx - yy);
  const double least = 0.5 * (xx + yy) - std::sqrt(half_gap * half_gap + xy * xy);
  return std::sqrt(reach2_px / std::max(least, 1e-12));
}

}  // namespace

void fill(RayArrays& rays, const core::Camera& camera, const estimation::Sightings& sightings,
          double max_residual_px) {
  rays.size = sightings.size();
  rays.centre_m = geometry::centre(camera.model);
  rays.direction_sum.setZero();
  double offset2 = 0.0;
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Sighting& sighting = sightings[i];
    const Eigen::Vector3d& direction = sighting.line.ray.direction;
    rays.direction_sum += direction;
    offset2 = std::max(offset2, (sighting.line.ray.origin - rays.centre_m).squaredNorm());
    rays.x[i] = static_cast<float>(direction.x());
    rays.y[i] = static_cast<float>(direction.y());
    rays.z[i] = static_cast<float>(direction.z());
    rays.near_m[i] =
        static_cast<float>(std::max({sighting.window.near_m, camera.distance_min_m, kLeastNear_m}));
    rays.far_m[i] = static_cast<float>(std::min(sighting.window.far_m, camera.distance_max_m));
    rays.box_tangent[i] = static_cast<float>(box_tangent(sighting, max_residual_px));
  }
  rays.origin_offset_m = std::sqrt(offset2);
}

}  // namespace dottrack::acquisition
