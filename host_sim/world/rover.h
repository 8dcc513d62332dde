#pragma once
// The vehicle: a six-wheeled rover under a solar deck, with a mast and antennas that get in the
// way. Vehicle coordinates: x forward, y left, z up, z = 0 where the wheels touch the ground.

#include <Eigen/Core>
#include <vector>

#include "host_sim/world/object.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::host_sim {

inline constexpr double kDeckHeight_m = 0.52;
inline constexpr double kHalfTrack_m = 0.59;  // from the middle to the middle of a wheel
inline constexpr double kWheelWidth_m = 0.18;
inline constexpr double kDotLift_m = 0.003;  // a dot is a plate on the deck

// The deck's outline, (x, y).
const std::vector<Eigen::Vector2d>& deck_outline();

// Where equipment stands on the deck: middle and radius that a dot must keep clear of.
struct Keepout {
  Eigen::Vector2d middle;
  double radius_m;
};
const std::vector<Keepout>& deck_keepouts();

struct Vehicle {
  std::vector<Object> objects;
  TargetLayout dots;
  Eigen::Vector3d box_min_m;  // everything is inside this box
  Eigen::Vector3d box_max_m;
};

Vehicle make_rover(const TargetLayout& dots);

}  // namespace dottrack::host_sim
