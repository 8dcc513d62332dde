#pragma once
// How the vehicle moves: a closed, smooth curve with a little heave, pitch and roll, exact in time.

#include <Eigen/Core>

#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

// In the curve's own axes, with phase f = phase_rad + rate_rad_s * t:
//   x = radius_x cos f,  y = radius_y sin f + wobble sin 2f.
// The vehicle's x axis follows the curve.
struct DrivePath {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d x_axis = Eigen::Vector2d::UnitX();  // of the curve, in the world; unit
  double radius_x_m = 1.7;
  double radius_y_m = 1.2;
  double wobble_m = 0.25;
  double phase_rad = 0.0;
  double rate_rad_s = 0.28;
  double heave_m = 0.015;
  double pitch_rad = 0.04;  // amplitudes
  double roll_rad = 0.03;
};

// T_world_vehicle at a time, seconds.
Pose pose_at(const DrivePath& path, double time_s);

// The curve whose vehicle is at `position_m` with heading `yaw_rad` (from world x) at time 0.
DrivePath starting_at(DrivePath path, const Eigen::Vector2d& position_m, double yaw_rad);

}  // namespace dottrack::host_sim
