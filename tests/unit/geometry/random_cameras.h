#pragma once
// Random cameras and points, the same ones on every run.

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "app/core/geometry/camera_model.h"

namespace dottrack::test {

class RandomCameras {
 public:
  explicit RandomCameras(std::uint32_t seed) : generator_(seed) {}

  // Scales of 300 to 1500 pixels, image centre near (320, 240), any place and attitude; a mirrored
  // image now and then. Axes are off unit length by up to 1e-5, as published ones are.
  geometry::Cahv cahv();
  // Barrel and pincushion, the optical axis up to some 2 degrees from A.
  geometry::Cahvor cahvor();
  // The pupil moves by some millimetres.
  geometry::Cahvore cahvore(double linearity);

  // Up to this angle from the axis and this far from the centre, metres.
  Eigen::Vector3d point_near(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                             double largest_angle_rad, double nearest_m, double farthest_m);

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Eigen::Vector3d unit();

 private:
  Eigen::Vector3d nearly_unit(const Eigen::Vector3d& direction);

  std::mt19937 generator_;
};

}  // namespace dottrack::test
