#pragma once
// What a line of sight meets first.

#include <Eigen/Core>
#include <limits>

namespace dottrack::host_sim {

// Surfaces of a scene by number: the ground, then the world's objects, then the vehicle's.
inline constexpr int kNothing = -1;
inline constexpr int kGround = 0;
inline constexpr int kFirstObject = 1;
inline constexpr int kFirstVehicleObject = 1 << 20;

struct SurfaceHit {
  int surface = kNothing;
  double distance = std::numeric_limits<double>::infinity();  // in units of the line's direction
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();           // unit, towards the eye; world
};

}  // namespace dottrack::host_sim
