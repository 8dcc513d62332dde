#pragma once
// A drive under the simulator's cameras as a run would record it, without pictures: the dots where
// the simulator's own camera mathematics sees them, round ones by their outlines, and noise.

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "app/config/camera_file.h"
#include "app/config/rig_file.h"
#include "app/workstation/survey/run_file.h"
#include "host_sim/renderer/camera_text.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/scenarios/ceiling.h"
#include "host_sim/world/pose.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline config::CameraFile model_of(const host_sim::SimCamera& camera) {
  auto file = config::parse_camera_text(host_sim::camera_text(camera, "c"), "c.cahvor");
  if (!file) throw std::runtime_error(file.error().message);
  return *file;
}

inline host_sim::Pose pose_at(double x, double y, double yaw, double tilt) {
  host_sim::Pose pose;
  pose.position_m = {x, y, 0.4 + 0.2 * std::sin(x)};
  pose.rotation = (Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(tilt * std::sin(3.0 * x), Vector3d::UnitX()) *
                   Eigen::AngleAxisd(tilt * std::cos(2.0 * y), Vector3d::UnitY()))
                      .toRotationMatrix();
  return pose;
}

// The middle of the outline's area.
inline std::optional<Vector2d> picture_of(const host_sim::SimCamera& camera,
                                          const host_sim::TargetDot& dot,
                                          const host_sim::Pose& pose) {
  constexpr int kCorners = 48;
  const Vector3d u = dot.normal.unitOrthogonal();
  const Vector3d v = dot.normal.cross(u);
  std::vector<Vector2d> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    const Vector3d p =
        dot.centre_m + 0.5 * dot.diameter_m * (std::cos(angle) * u + std::sin(angle) * v);
    const auto pixel = camera.project(pose.to_world(p));
    if (!pixel || pixel->x() < 4.0 || pixel->y() < 4.0 || pixel->x() > camera.width_px() - 5.0 ||
        pixel->y() > camera.height_px() - 5.0) {
      return std::nullopt;
    }
    rim.push_back(*pixel);
  }
  const Vector2d origin = rim[0];
  double area = 0.0;
  Vector2d moment = Vector2d::Zero();
  for (int i = 0; i < kCorners; ++i) {
    const Vector2d a = rim[static_cast<std::size_t>(i)] - origin;
    const Vector2d b = rim[static_cast<std::size_t>((i + 1) % kCorners)] - origin;
    const double twice = a.x() * b.y() - a.y() * b.x();
    area += 0.5 * twice;
    moment += twice * (a + b) / 6.0;
  }
  return origin + moment / area;
}

struct DriveOptions {
  std::size_t ticks = 300;
  double noise_px = 0.04;
  double wrong_share = 0.01;  // of the views: off by a pixel or so
  std::uint64_t seed = 1;
};

class RecordedDrive {
 public:
  explicit RecordedDrive(std::uint64_t seed = 1, host_sim::TargetLayout layout = {})
      : layout_(layout.empty() ? host_sim::demo_layout() : std::move(layout)) {
    host_sim::CeilingOptions ceiling;
    ceiling.seed = seed;
    for (const auto& place : host_sim::ceiling_places(ceiling)) {
      cameras_.push_back(host_sim::ceiling_camera(ceiling, cameras_.size(), place));
      core::Camera camera;
      camera.model = model_of(cameras_.back()).model;
      camera.width_px = 640;
      camera.height_px = 480;
      camera.distance_min_m = 1.0;
      camera.distance_max_m = 20.0;
      rig.cameras.push_back(camera);
    }
    for (const auto& dot : layout_) {
      rig.target.dots.push_back({dot.centre_m, dot.diameter_m, dot.normal});
    }
  }

  const host_sim::SimCamera& camera(std::size_t i) const { return cameras_[i]; }
  // From now on it really stands so; the rig does not know.
  void move_camera(std::size_t i, const host_sim::SimCamera& to) {
    cameras_[i] = to;
    moved_ = i;
  }

  // Round the sandbox; the poses are the truth, to `pose_sigma_m`.
  std::vector<workstation::RecordedTick> drive(const DriveOptions& options) const {
    std::mt19937_64 random(options.seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> part;
    std::vector<workstation::RecordedTick> ticks;
    for (std::size_t k = 0; k < options.ticks; ++k) {
      const double way = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(options.ticks);
      const auto pose = pose_at(7.5 * std::cos(way), 2.6 * std::sin(2.0 * way), way + 0.7, 0.08);
      workstation::RecordedTick tick;
      tick.tick = k;
      tick.pose.position_m = pose.position_m;
      tick.pose.orientation = pose.orientation();
      for (std::size_t c = 0; c < cameras_.size(); ++c) {
        for (std::size_t d = 0; d < layout_.size(); ++d) {
          auto pixel = picture_of(cameras_[c], layout_[d], pose);
          if (!pixel) continue;
          const double noise_px = part(random) < options.wrong_share ? 1.0 : options.noise_px;
          const Vector2d noise{normal(random), normal(random)};
          tick.views.push_back({c, d, *pixel + noise_px * noise, moved_ == c});
        }
      }
      ticks.push_back(std::move(tick));
    }
    return ticks;
  }

  core::Rig rig;

 private:
  host_sim::TargetLayout layout_;
  std::vector<host_sim::SimCamera> cameras_;
  std::optional<std::size_t> moved_;
};

}  // namespace dottrack::test
