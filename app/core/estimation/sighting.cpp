#include "app/core/estimation/sighting.h"

#include "app/core/estimation/sighting_bounds.h"

namespace dottrack::estimation {

bool describe_sighting(const core::Camera& camera, const geometry::Optics& optics,
                       const DiameterRange& diameter, const image::Region& region,
                       Sighting& sighting) {
  const geometry::AngularScale& scale = optics.at(region.centroid_px);
  if (scale.max_px <= 0.0) return false;
  sighting.window = possible_range(diameter, region.semi_major_px, scale,
                                   {camera.distance_min_m, camera.distance_max_m});
  if (sighting.window.empty()) return false;
  const double mean_px = scale.mean_px();
  sighting.line.sigma_rad = kCentroidSigma_px / mean_px;
  sighting.take_shape(region);
  sighting.angular_diameter_rad = 2.0 * region.semi_major_px / mean_px;
  return true;
}

bool add_line_of_sight(const core::Camera& camera, Sighting& sighting) {
  if (geometry::unproject(camera.model, sighting.pixel, sighting.line.ray) !=
      geometry::OpticsStatus::ok) {
    return false;
  }
  const double middle_m = 0.5 * (sighting.window.near_m + sighting.window.far_m);
  Eigen::Vector2d pixel;
  if (geometry::project(camera.model,
                        sighting.line.ray.origin + middle_m * sighting.line.ray.direction, pixel,
                        &sighting.pixels_per_rad) != geometry::OpticsStatus::ok) {
    return false;
  }
  sighting.pixels_per_rad *= middle_m;
  return true;
}

bool make_sighting(const core::Camera& camera, const geometry::Optics& optics,
                   const DiameterRange& diameter, const image::Region& region, Sighting& sighting) {
  return describe_sighting(camera, optics, diameter, region, sighting) &&
         add_line_of_sight(camera, sighting);
}

}  // namespace dottrack::estimation
