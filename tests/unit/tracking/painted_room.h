#pragma once
// A room of ceiling cameras and a vehicle whose dots are painted as bright discs: the least that a
// tracker needs to see. Judging accuracy is left to the simulator, whose optics are its own.

#include <Eigen/Geometry>
#include <array>
#include <random>
#include <vector>

#include "app/core/geometry/optics.h"
#include "app/core/tracker.h"
#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::core::test {

using Eigen::Vector3d;

class PaintedRoom {
 public:
  explicit PaintedRoom(std::size_t dots = 4) : cameras_(acquisition::test::ceiling_cameras()) {
    const std::array<Vector3d, 8> layout = {
        Vector3d(0.45, 0.30, 0.0),   Vector3d(-0.50, 0.25, 0.0), Vector3d(-0.35, -0.33, 0.05),
        Vector3d(0.30, -0.20, 0.0),  Vector3d(0.05, 0.42, 0.0),  Vector3d(0.60, -0.40, 0.02),
        Vector3d(-0.10, -0.05, 0.1), Vector3d(-0.62, -0.10, 0.0)};
    for (const Camera& camera : cameras_) rig.cameras.push_back(camera);
    for (Camera& camera : rig.cameras) camera.intensity_min_dn = 100;
    for (std::size_t i = 0; i < dots; ++i) rig.target.dots.push_back({layout[i], 0.1, {}});
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      optics_.emplace_back(rig.cameras[i].model, 640, 480);
      images_[i].resize(640 * 480);
    }
    clear();
  }

  static Pose pose_at(double x, double y, double heading_rad) {
    Pose pose;
    pose.position_m = {x, y, 0.4};
    pose.orientation = Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ());
    return pose;
  }

  void clear(std::uint8_t grey = 20) {
    for (auto& image : images_) std::fill(image.begin(), image.end(), grey);
  }

  void paint_vehicle(const Pose& pose) {
    for (std::size_t dot = 0; dot < rig.target.dots.size(); ++dot) paint_dot(pose, dot);
  }
  void paint_dot(const Pose& pose, std::size_t dot) {
    const TargetDot& d = rig.target.dots[dot];
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
      paint(c, pose.orientation * d.position_m + pose.position_m, d.diameter_m);
    }
  }
  void paint_dot_in(std::size_t camera, const Pose& pose, std::size_t dot) {
    const TargetDot& d = rig.target.dots[dot];
    paint(camera, pose.orientation * d.position_m + pose.position_m, d.diameter_m);
  }
  // Bright discs of the dots' size, anywhere in the room, and specks of noise.
  void paint_clutter(std::size_t discs, unsigned seed) {
    std::mt19937 random(seed);
    for (const Vector3d& p : acquisition::test::points_in_room(discs, random)) {
      for (std::size_t c = 0; c < rig.cameras.size(); ++c) paint(c, p, 0.1);
    }
  }
  void paint_noise(unsigned seed) {
    std::mt19937 random(seed);
    for (auto& image : images_) {
      for (auto& pixel : image) pixel = static_cast<std::uint8_t>(random() & 0xFFU);
    }
  }

  // Paints a disc facing the camera, with soft edges.
  void paint(std::size_t camera, const Vector3d& place_m, double diameter_m) {
    Eigen::Vector2d centre;
    const geometry::CameraModel& model = rig.cameras[camera].model;
    if (geometry::project(model, place_m, centre) != geometry::OpticsStatus::ok) return;
    const double range_m = (place_m - geometry::centre(model)).norm();
    const double radius = 0.5 * diameter_m / range_m * optics_[camera].at(centre).mean_px();
    for (int y = int(centre.y() - radius) - 2; y <= int(centre.y() + radius) + 2; ++y) {
      for (int x = int(centre.x() - radius) - 2; x <= int(centre.x() + radius) + 2; ++x) {
        if (x < 0 || y < 0 || x >= 640 || y >= 480) continue;
        const double inside = radius + 0.5 - (Eigen::Vector2d(x, y) - centre).norm();
        auto& pixel = images_[camera][static_cast<std::size_t>(640 * y + x)];
        const double value = 20.0 + 180.0 * std::clamp(inside, 0.0, 1.0);
        pixel = std::max(pixel, static_cast<std::uint8_t>(value));
      }
    }
  }

  std::array<CameraFrame, kMaxCameras> frames(Time at = Time{}) const {
    std::array<CameraFrame, kMaxCameras> f{};
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      f[i] = {true, {images_[i].data(), 640, 480, 640}, at};
    }
    return f;
  }

  Rig rig;

 private:
  std::vector<Camera> cameras_;
  std::vector<geometry::Optics> optics_;
  std::array<std::vector<std::uint8_t>, kMaxCameras> images_;
};

inline double position_error_m(const TickResult& result, const Pose& truth) {
  return (result.pose.position_m - truth.position_m).norm();
}

inline double attitude_error_deg(const TickResult& result, const Pose& truth) {
  return result.pose.orientation.angularDistance(truth.orientation) * 57.29577951308232;
}

}  // namespace dottrack::core::test
