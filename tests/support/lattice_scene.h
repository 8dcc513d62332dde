#pragma once
// The worst that acquisition can be given: sixteen cameras whose every region is a point of one
// lattice, and a target that fits the lattice everywhere. All capacities are full, nothing is ruled
// out early, and no labelling is better than its neighbours.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"

namespace dottrack::test {

class LatticeScene {
 public:
  static constexpr double kSpacing_m = 0.2;

  LatticeScene() {
    for (std::size_t i = 0; i < kMaxCameras; ++i) add_camera(i);
    for (int k = 0; k < 16; ++k) {
      const Eigen::Vector3d place(kSpacing_m * (k % 4), kSpacing_m * (k / 4), 0.0);
      rig.target.dots.push_back({place, kDiameter_m, {}});
    }
    for (std::size_t i = 0; i < kMaxCameras; ++i) look(i);
  }

  std::array<const image::Regions*, kMaxCameras> regions() const {
    std::array<const image::Regions*, kMaxCameras> all{};
    for (std::size_t i = 0; i < kMaxCameras; ++i) all[i] = &regions_[i];
    return all;
  }

  core::Rig rig;
  std::vector<geometry::Optics> optics;

 private:
  static constexpr double kDiameter_m = 0.08;
  static constexpr int kSide = 32;  // points, squared: as many as a camera may have regions
  static_assert(std::size_t{kSide} * kSide == core::kMaxRegions);

  void add_camera(std::size_t i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kMaxCameras;
    const Eigen::Vector3d place(7.0 * std::cos(angle), 7.0 * std::sin(angle), 5.0);
    const Eigen::Vector3d axis = -place.normalized();
    const Eigen::Vector3d right = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
    geometry::Cahv model;
    model.c = place;
    model.a = axis;
    model.h = 900.0 * right + 639.5 * axis;
    model.v = 900.0 * axis.cross(right) + 511.5 * axis;
    core::Camera camera;
    camera.model = model;
    camera.width_px = 1280;
    camera.height_px = 1024;
    camera.distance_min_m = 2.0;
    camera.distance_max_m = 16.0;
    rig.cameras.push_back(camera);
    optics.emplace_back(camera.model, camera.width_px, camera.height_px);
  }

  void look(std::size_t camera) {
    const core::Camera& c = rig.cameras[camera];
    for (int k = 0; k < kSide * kSide; ++k) {
      const Eigen::Vector3d point(kSpacing_m * (k % kSide - 0.5 * kSide),
                                  kSpacing_m * (k / kSide - 0.5 * kSide), 0.0);
      image::Region region;
      if (geometry::project(c.model, point, region.centroid_px) != geometry::OpticsStatus::ok) {
        continue;
      }
      const double range_m = (point - geometry::centre(c.model)).norm();
      const double r =
          0.5 * kDiameter_m / range_m * optics[camera].at(region.centroid_px).mean_px();
      region.semi_major_px = region.semi_minor_px = r;
      region.area_px = static_cast<int>(std::numbers::pi * r * r);
      region.x_min = static_cast<std::int16_t>(region.centroid_px.x() - r);
      region.x_max = static_cast<std::int16_t>(region.centroid_px.x() + r);
      region.y_min = static_cast<std::int16_t>(region.centroid_px.y() - r);
      region.y_max = static_cast<std::int16_t>(region.centroid_px.y() + r);
      regions_[camera].push_back(region);
    }
  }

  std::array<image::Regions, kMaxCameras> regions_;
};

}  // namespace dottrack::test
