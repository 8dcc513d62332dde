#pragma once
// Five ways in which the vehicle may be moving, and what each makes of a state after some time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/estimation/motion_state.h"
#include "app/core/rig.h"

namespace dottrack::estimation {

enum class MotionModel : std::uint8_t {
  at_rest = 0,  // no velocity; the place trembles by what floors and mounts do
  steady = 1,   // velocity and rates stay, but for a small part of what the vehicle can
  eased = 2,    // speeds up, brakes and turns gently
  driven = 3,   // acceleration anywhere within the vehicle's limits
  struck = 4,   // another velocity at once: pushed, or stopped by an obstacle
};
inline constexpr std::size_t kMotionModels = 5;

// An acceleration is taken to hold for about so long before it is another one: accelerations of
// standard deviation s are white noise of density s^2 times this. Over a longer prediction, as when
// coasting, one acceleration may hold for longer.
inline constexpr double kAccelerationHolds_s = 0.1;
inline constexpr double kLongestHold_s = 0.3;
// Of the limit, per axis: the standard deviation of the acceleration.
inline constexpr double kDrivenPart = 0.5;
inline constexpr double kEasedPart = 0.1;
inline constexpr double kSteadyPart = 0.01;
// Of the speed limit, per axis: the standard deviation of a struck vehicle's change of velocity.
inline constexpr double kStruckPart = 0.5;
// A random walk at rest: after a second it has come so far. It is the floor of the covariance.
inline constexpr double kTremor_m = 0.05e-3;
inline constexpr double kTremor_rad = 0.05e-3;
// What is still called rest.
inline constexpr double kRestSpeed_m_s = 0.1e-3;
inline constexpr double kRestRate_rad_s = 0.1e-3;

// How often, per second, one way of moving gives way to another: kSwitchesPerSecond[from][to].
// A struck vehicle is so for one tick only; its row is the shares of what comes next, of which rest
// is none: else every tick could be a blow that ends at once, and a vehicle at rest would be known
// less well. Those from rest are what makes the covariance true for vehicles that start about once
// a second (docs/adr/0037).
using ModelTable = std::array<std::array<double, kMotionModels>, kMotionModels>;
inline constexpr ModelTable kSwitchesPerSecond{{
    {0.0, 0.0, 1.2, 0.8, 0.005},
    {0.0, 0.0, 1.0, 1.5, 0.005},
    {0.2, 0.5, 0.0, 1.2, 0.005},
    {0.2, 0.5, 0.5, 0.0, 0.005},
    {0.0, 0.3, 0.3, 0.4, 0.0},
}};

// The probability of each way of moving after `seconds`, given each before.
ModelTable switching(double seconds);

// The state `seconds` later, with the covariance that it then has. With negative `seconds` the
// place goes back, and the covariance grows as it does forward.
void advance(MotionModel model, const core::MotionLimits& limits, double seconds,
             MotionState& state, double hold_s = kAccelerationHolds_s);

}  // namespace dottrack::estimation
