#pragma once
// Two cameras with sightings that belong together by a hair: whatever each gate allows, they use.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "app/core/acquisition/match.h"
#include "app/core/geometry/crossover.h"

namespace dottrack::acquisition::test {

class EdgePairs {
 public:
  // Cameras 5 mm to 10 m apart. In every second rig the rays come from up to 1 cm off the centres,
  // and every second two have so small a miss that single precision is the larger error.
  EdgePairs(std::size_t pairs, std::uint32_t seed) : random_(seed) {
    const Eigen::Vector3d centre = 5.0 * direction();
    pupil_m_ = seed % 2 == 0 ? 0.0 : 0.01;
    max_miss_m_ = seed % 4 < 2 ? 0.1 : 1e-7;
    const double baseline_m = std::pow(10.0, between(-2.3, 1.0));
    place(cameras_[0], centre);
    place(cameras_[1], centre + baseline_m * direction());
    for (std::size_t i = 0; i < 2; ++i) views_[i].camera = &cameras_[i];
    for (std::size_t k = 0; k < pairs; ++k) add_pair();
  }
  EdgePairs(const EdgePairs&) = delete;
  EdgePairs& operator=(const EdgePairs&) = delete;

  // Sighting k of one camera belongs to sighting k of the other.
  std::span<const CameraView> views() const { return views_; }

  double max_miss_m() const { return max_miss_m_; }

 private:
  // How near to its edge a gate is used, metres or pixels: far above double precision.
  static constexpr double kHair = 1e-9;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }
  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
  }

  static void place(core::Camera& camera, const Eigen::Vector3d& centre) {
    geometry::Cahv model;
    model.c = centre;
    camera.model = model;
    camera.distance_min_m = 1e-3;
    camera.distance_max_m = 50.0;
  }

  // All round the baseline, ahead of the cameras and behind them, or close to the baseline.
  Eigen::Vector3d place_of_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d middle = 0.5 * (a + b);
    if (!one_in(4)) return middle + between(0.3, 8.0) * direction();
    return middle + between(-3.0, 3.0) * (b - a) +
           std::pow(10.0, between(-5.0, -0.5)) * direction();
  }

  void add_pair() {
    const Eigen::Vector3d a = geometry::centre(cameras_[0].model) + pupil_m_ * direction();
    const Eigen::Vector3d b = geometry::centre(cameras_[1].model) + pupil_m_ * direction();
    // Both rays are at right angles to the shortest line between them.
    const double between_m = (b - a).norm();
    const double part = one_in(2) ? 1.0 : between(0.0, 1.0);
    const double miss_m = part * std::min(max_miss_m_ - kHair, 0.99 * between_m);
    const Eigen::Vector3d axis = (b - a) / between_m;
    const Eigen::Vector3d off = axis.cross(direction()).normalized();
    const double slope = miss_m / between_m;
    const Eigen::Vector3d shortest = slope * axis + std::sqrt(1.0 - slope * slope) * off;
    Eigen::Vector3d point = place_of_dot(a, b);
    point -= (point - 0.5 * (a + b)).dot(shortest) * shortest;
    const std::array<geometry::Ray, 2> rays = {
        geometry::Ray{a, (point - 0.5 * miss_m * shortest - a).normalized()},
        geometry::Ray{b, (point + 0.5 * miss_m * shortest - b).normalized()}};
    geometry::Crossover cross;
    if (closest_crossover(rays[0], rays[1], cross) != geometry::CrossoverStatus::ok) return;
    views_[0].sightings.push_back(sighting(rays[0], cross.range_a_m, cross.point_m, shortest));
    views_[1].sightings.push_back(sighting(rays[1], cross.range_b_m, cross.point_m, shortest));
  }

  estimation::Sighting sighting(const geometry::Ray& ray, double range_m,
                                const Eigen::Vector3d& point, const Eigen::Vector3d& shortest) {
    estimation::Sighting result;
    result.line.ray = ray;
    const double near_m = std::max(range_m - kHair, 1e-4);
    result.window = {one_in(3) ? 0.5 * near_m : near_m,
                     one_in(3) ? 2.0 * range_m : range_m + kHair};
    result.pixel = {between(0.0, 640.0), between(0.0, 480.0)};
    // A lens that moves the pixel least, or anyhow, along the shortest line.
    const double turn = one_in(2) ? 0.0 : between(0.0, std::numbers::pi);
    const Eigen::Vector3d weak =
        std::cos(turn) * shortest + std::sin(turn) * ray.direction.cross(shortest);
    const double scale = between(100.0, 2000.0);
    Eigen::Matrix<double, 2, 3> unturned;
    unturned.row(0) = between(0.3, 1.0) * scale * weak;
    unturned.row(1) = scale * ray.direction.cross(weak);
    result.pixels_per_rad =
        Eigen::Rotation2Dd(between(0.0, std::numbers::pi)).toRotationMatrix() * unturned;
    const Eigen::Vector2d there = result.pixel_of(point);
    const double more_px = one_in(2) ? kHair : between(0.0, 20.0);
    result.box_min_px = there.cwiseMin(result.pixel).array() - more_px;
    result.box_max_px = there.cwiseMax(result.pixel).array() + more_px;
    return result;
  }

  std::mt19937 random_;
  double pupil_m_ = 0.0;
  double max_miss_m_ = 0.0;
  std::array<core::Camera, 2> cameras_;
  std::array<CameraView, 2> views_;
};

}  // namespace dottrack::acquisition::test
