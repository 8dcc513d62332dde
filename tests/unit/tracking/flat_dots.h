#pragma once
// Five ceiling cameras over flat discs that lie or lean any way: each pixel's share of a disc is
// found by following rays to the disc's plane, so the pictures know nothing of ellipses.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "app/core/camera_frame.h"
#include "app/core/geometry/optics.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::tracking::test {

using Eigen::Vector3d;

inline core::Camera ceiling_camera(const Vector3d& place, const Vector3d& towards) {
  const double f = 500.0;
  const Vector3d axis = (towards - place).normalized();
  const Vector3d right = axis.cross(Vector3d::UnitZ()).normalized();
  geometry::Cahv model;
  model.c = place;
  model.a = axis;
  model.h = f * right + 319.5 * axis;
  model.v = f * axis.cross(right) + 239.5 * axis;
  core::Camera camera;
  camera.model = model;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.distance_min_m = 1.0;
  camera.distance_max_m = 12.0;
  camera.intensity_min_dn = 100;
  return camera;
}

class FlatDots {
 public:
  static constexpr double kDiameter_m = 0.12;

  FlatDots() {
    const Vector3d middle(4.0, 3.0, 0.4);
    for (const Vector3d& place :
         {Vector3d(1.5, 1.0, 3.0), Vector3d(6.5, 1.2, 3.2), Vector3d(1.2, 5.0, 3.1),
          Vector3d(6.8, 5.0, 3.0), Vector3d(4.0, 0.2, 3.4)}) {
      rig.cameras.push_back(ceiling_camera(place, middle));
    }
    for (const Vector3d& place : {Vector3d(0.45, 0.30, 0.0), Vector3d(-0.50, 0.25, 0.0),
                                  Vector3d(-0.35, -0.33, 0.05), Vector3d(0.30, -0.20, 0.0)}) {
      rig.target.dots.push_back({place, kDiameter_m, Vector3d::UnitZ()});
    }
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      optics.emplace_back(rig.cameras[i].model, 640, 480);
      images_[i].assign(640 * 480, 20);
    }
  }

  static core::Pose pose_at(double x, double y, double heading_rad) {
    core::Pose pose;
    pose.position_m = {x, y, 0.4};
    pose.orientation = Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ());
    return pose;
  }

  // Lean all dots the same way, in the vehicle's coordinates.
  void lean(const Vector3d& normal) {
    for (core::TargetDot& dot : rig.target.dots) dot.normal = normal.normalized();
  }

  void clear(std::size_t camera) {
    std::fill(images_[camera].begin(), images_[camera].end(), std::uint8_t{20});
  }

  void paint(const core::Pose& pose) {
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
      clear(c);
      for (std::size_t d = 0; d < rig.target.dots.size(); ++d) paint_dot(c, d, pose);
    }
  }
  void paint_dot(std::size_t camera, std::size_t dot, const core::Pose& pose) {
    const core::TargetDot& d = rig.target.dots[dot];
    paint_disc(camera, pose.orientation * d.position_m + pose.position_m,
               pose.orientation * *d.normal);
  }

  // Seen from the front or from the back.
  void paint_disc(std::size_t camera, const Vector3d& place_m, const Vector3d& normal) {
    const geometry::CameraModel& model = rig.cameras[camera].model;
    Eigen::Vector2d middle;
    if (geometry::project(model, place_m, middle) != geometry::OpticsStatus::ok) return;
    constexpr int kReach_px = 14;  // a radius at 2.5 m is 12 px
    for (int y = int(middle.y()) - kReach_px; y <= int(middle.y()) + kReach_px; ++y) {
      for (int x = int(middle.x()) - kReach_px; x <= int(middle.x()) + kReach_px; ++x) {
        if (x < 0 || y < 0 || x >= 640 || y >= 480) continue;
        auto& pixel = images_[camera][static_cast<std::size_t>(640 * y + x)];
        const double value = 20.0 + 180.0 * share(model, x, y, place_m, normal);
        pixel = std::max(pixel, static_cast<std::uint8_t>(value));
      }
    }
  }

  std::array<core::CameraFrame, kMaxCameras> frames() const {
    std::array<core::CameraFrame, kMaxCameras> f{};
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      f[i] = {true, {images_[i].data(), 640, 480, 640}, Time{}};
    }
    return f;
  }

  core::Rig rig;
  std::vector<geometry::Optics> optics;

 private:
  // Of the pixel, from 5 x 5 rays.
  static double share(const geometry::CameraModel& model, int x, int y, const Vector3d& place_m,
                      const Vector3d& normal) {
    int hits = 0;
    for (int i = 0; i < 25; ++i) {
      geometry::Ray ray;
      const Eigen::Vector2d pixel(x + (i % 5 - 2) / 5.0, y + (i / 5 - 2) / 5.0);
      if (geometry::unproject(model, pixel, ray) != geometry::OpticsStatus::ok) continue;
      const double along = (place_m - ray.origin).dot(normal) / ray.direction.dot(normal);
      const Vector3d hit = ray.origin + along * ray.direction;
      if (along > 0.0 && (hit - place_m).norm() <= 0.5 * kDiameter_m) ++hits;
    }
    return hits / 25.0;
  }

  std::array<std::vector<std::uint8_t>, kMaxCameras> images_;
};

}  // namespace dottrack::tracking::test
