#pragma once
// What ceiling cameras would make of points in a room: sightings without images.

#include <Eigen/Geometry>
#include <memory>
#include <random>
#include <vector>

#include "app/core/acquisition/match.h"

namespace dottrack::acquisition::test {

inline core::Camera ceiling_camera(const Eigen::Vector3d& place, const Eigen::Vector3d& towards) {
  const double f = 450.0;
  const Eigen::Vector3d axis = (towards - place).normalized();
  const Eigen::Vector3d right = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d down = axis.cross(right);
  geometry::Cahv model;
  model.c = place;
  model.a = axis;
  model.h = f * right + 319.5 * axis;
  model.v = f * down + 239.5 * axis;
  core::Camera camera;
  camera.model = model;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.distance_min_m = 2.0;
  camera.distance_max_m = 12.0;
  return camera;
}

inline std::vector<core::Camera> ceiling_cameras() {
  const Eigen::Vector3d middle(4.0, 3.0, 0.0);
  return {ceiling_camera({0.0, 0.0, 5.0}, middle), ceiling_camera({8.0, 0.0, 5.0}, middle),
          ceiling_camera({0.2, 6.0, 4.8}, middle), ceiling_camera({8.1, 6.0, 5.2}, middle),
          ceiling_camera({4.0, -0.5, 5.1}, middle)};
}

// One camera's view of discs of the given diameter at the points, a fraction of a pixel off.
inline void see(const core::Camera& camera, const std::vector<Eigen::Vector3d>& points,
                double diameter_m, double noise_px, std::mt19937& random, CameraView& view) {
  const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
  std::normal_distribution<double> noise(0.0, noise_px);
  view.camera = &camera;
  view.sightings.clear();
  for (const Eigen::Vector3d& point : points) {
    Eigen::Vector2d pixel;
    if (geometry::project(camera.model, point, pixel) != geometry::OpticsStatus::ok) continue;
    if (pixel.x() < 10 || pixel.y() < 10 || pixel.x() > 630 || pixel.y() > 470) continue;
    const double range_m = (point - geometry::centre(camera.model)).norm();
    image::Region region;
    region.centroid_px = pixel;
    for (const int axis : {1, 0}) region.centroid_px[axis] += noise(random);
    region.semi_major_px = 0.5 * diameter_m / range_m * optics.at(pixel).mean_px();
    region.semi_minor_px = region.semi_major_px;
    const double r = region.semi_major_px;
    region.x_min = static_cast<std::int16_t>(std::lround(region.centroid_px.x() - r));
    region.x_max = static_cast<std::int16_t>(std::lround(region.centroid_px.x() + r));
    region.y_min = static_cast<std::int16_t>(std::lround(region.centroid_px.y() - r));
    region.y_max = static_cast<std::int16_t>(std::lround(region.centroid_px.y() + r));
    estimation::Sighting sighting;
    if (!estimation::make_sighting(camera, optics, {diameter_m, diameter_m}, region, sighting))
      continue;
    sighting.region = static_cast<std::uint16_t>(view.sightings.size());
    view.sightings.push_back(sighting);
  }
}

inline std::vector<Eigen::Vector3d> points_in_room(std::size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> x(1.0, 7.0);
  std::uniform_real_distribution<double> y(1.0, 5.0);
  std::uniform_real_distribution<double> z(0.0, 1.0);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double up = z(random);
    const double left = y(random);
    points.emplace_back(x(random), left, up);
  }
  return points;
}

}  // namespace dottrack::acquisition::test
