#pragma once
// Twelve ceiling cameras over a room of 22 x 9 m: dots that all see, and clutter that each has for
// itself.

#include <random>
#include <vector>

#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::acquisition::test {

inline std::vector<core::Camera> room_cameras() {
  std::vector<core::Camera> cameras;
  for (int i = 0; i < 12; ++i) {
    const double x = 1.0 + 4.0 * (i % 6);
    const double y = i < 6 ? 0.0 : 9.0;
    cameras.push_back(ceiling_camera({x, y, 5.0}, {0.7 * x + 0.3 * 11.0, 4.5, 0.0}));
    cameras.back().distance_max_m = 14.0;
  }
  return cameras;
}

inline std::vector<Eigen::Vector3d> points_in_hall(std::size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = 22.0 * part(random);
    const double y = 9.0 * part(random);
    points.emplace_back(x, y, part(random));
  }
  return points;
}

// Regions of a dot's size anywhere in the image, none closer to another than their boxes touch.
inline void add_clutter(const core::Camera& camera, std::size_t regions, double diameter_m,
                        std::mt19937& random, CameraView& view) {
  const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
  std::uniform_real_distribution<double> x(10.0, 630.0);
  std::uniform_real_distribution<double> y(10.0, 470.0);
  std::uniform_real_distribution<double> range(3.0, 13.0);
  view.camera = &camera;
  for (std::size_t tries = 0; view.sightings.size() < regions && tries < 20 * regions; ++tries) {
    image::Region region;
    region.centroid_px = {x(random), y(random)};
    const double r = 0.5 * diameter_m / range(random) * optics.at(region.centroid_px).mean_px();
    bool free = true;
    for (const estimation::Sighting& s : view.sightings) {
      const double apart = r + s.semi_major_px + 1.5;
      free = free && (s.pixel - region.centroid_px).norm() > apart;
    }
    if (!free) continue;
    region.semi_major_px = region.semi_minor_px = r;
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

// A dot, and which of a camera's sightings it is.
struct SeenDot {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  CameraSet cameras;
  std::array<std::uint16_t, kMaxCameras> sighting{};
};

// Dots that cameras see with some noise, in front of everything else, among clutter. A dot that
// another one hides or touches in a camera is not seen there.
inline std::vector<SeenDot> see_room(const std::vector<core::Camera>& cameras,
                                     const std::vector<Eigen::Vector3d>& points,
                                     std::size_t regions, double diameter_m, double noise_px,
                                     std::mt19937& random, std::vector<CameraView>& views) {
  std::vector<SeenDot> dots;
  for (const Eigen::Vector3d& point : points) dots.push_back({point, {}, {}});
  CameraView one;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    views[c].camera = &cameras[c];
    views[c].sightings.clear();
    for (SeenDot& dot : dots) {
      const double range_m = (dot.position_m - geometry::centre(cameras[c].model)).norm();
      if (range_m > cameras[c].distance_max_m) continue;
      see(cameras[c], {dot.position_m}, diameter_m, noise_px, random, one);
      if (one.sightings.empty()) continue;
      bool free = true;
      for (const estimation::Sighting& s : views[c].sightings) {
        const double apart = s.semi_major_px + one.sightings[0].semi_major_px + 1.5;
        free = free && (s.pixel - one.sightings[0].pixel).norm() > apart;
      }
      if (!free) continue;
      dot.cameras.insert(c);
      dot.sighting[c] = static_cast<std::uint16_t>(views[c].sightings.size());
      views[c].sightings.push_back(one.sightings[0]);
    }
    add_clutter(cameras[c], regions, diameter_m, random, views[c]);
  }
  return dots;
}

}  // namespace dottrack::acquisition::test
