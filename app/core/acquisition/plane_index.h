#pragma once
// Finds the sightings of one camera whose rays can cross a given ray of another camera.
//
// Every ray of either camera lies in one plane of the pencil around the baseline. Two rays can pass
// within d of each other only where the angle between their planes is at most asin(d / rho), rho
// being the distance of the crossing from the baseline. The sightings are kept in buckets of the
// plane's angle, so that a ray is tested against few others.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/estimation/sighting.h"

namespace dottrack::acquisition {

// The pencil of planes around the line through two cameras' centres.
class PlanePencil {
 public:
  // scene: a point in front of both cameras; angles are measured from the plane through it.
  PlanePencil(const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b,
              const Eigen::Vector3d& scene);

  // False when the centres coincide: the cameras see along the same lines and form no pairs.
  bool has_baseline() const { return has_baseline_; }

  // A monotonic stand-in for the plane's angle in [-2, 2]; it never changes faster than the angle.
  double angle(const Eigen::Vector3d& direction) const;
  // Sine of the angle between the direction and the baseline.
  double sine_to_baseline(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d across_;
  Eigen::Vector3d up_;
  bool has_baseline_ = false;
};

// Buckets of one camera's sightings by plane angle. Rebuilt for each pair of cameras.
class PlaneIndex {
 public:
  void build(const PlanePencil& pencil, const estimation::Sightings& sightings);

  // Indices of sightings whose plane angle may be within the tolerance (radians) of `angle`;
  // a few others come along, none is missed.
  std::span<const std::uint16_t> near(double angle, double tolerance) const;

 private:
  static constexpr int kBuckets = 512;

  int bucket(double angle) const;

  std::array<std::uint16_t, kBuckets + 1> start_{};
  std::array<std::uint16_t, core::kMaxRegions> order_{};
  std::array<std::uint16_t, core::kMaxRegions> bucket_of_{};
  std::array<double, core::kMaxRegions> angle_{};
  double low_ = 0.0;
  double buckets_per_angle_ = 0.0;
  std::size_t size_ = 0;
};

}  // namespace dottrack::acquisition
