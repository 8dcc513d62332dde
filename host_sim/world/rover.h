#pragma once
// The vehicle: a six-wheeled rover under a solar deck, with a mast, antennas and cables that get in
// the way. Vehicle coordinates: x forward, y left, z up, z = 0 where the wheels touch the ground.

#include <Eigen/Core>
#include <vector>

#include "host_sim/world/model.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::host_sim {

inline constexpr double kDeckHeight_m = 0.52;  // the dots lie in this plane
inline constexpr double kHalfTrack_m = 0.59;   // from the middle to the middle of a wheel
inline constexpr double kHalfWheelBase_m = 0.54;
inline constexpr double kWheelWidth_m = 0.18;
inline constexpr double kDotAlbedo = 0.88;

// The deck's outline, (x, y), counter-clockwise.
const std::vector<Eigen::Vector2d>& deck_outline();

// Where equipment stands on the deck: middle and radius that a dot must keep clear of.
struct Keepout {
  Eigen::Vector2d middle;
  double radius_m;
};
const std::vector<Keepout>& deck_keepouts();

// The dots are the first marks, in the order of the layout.
Model make_rover(const TargetLayout& dots);

// A dark plate with the same dots in the same place, z = 0 as far below it as below the deck, that
// hangs from a rod and a crane's hook.
Model make_hanging_target(const TargetLayout& dots);

}  // namespace dottrack::host_sim
