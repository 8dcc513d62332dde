#pragma once
// Everything that is not the vehicle: rocks, boxes, the sandbox's boards, walls, and bright discs
// of about a dot's size that are not dots.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "host_sim/world/object.h"

namespace dottrack::host_sim {

struct ClutterOptions {
  std::uint64_t seed = 1;
  double half_length_m = 4.0;  // of the sandbox
  double half_width_m = 3.0;
  int look_alikes = 24;  // discs on the floor, 7 to 13 cm
  int rocks = 36;
  int boxes = 7;
  // How far a point of the floor is from where the vehicle comes; tall things keep clear of it.
  std::function<double(const Eigen::Vector2d&)> distance_to_drive_m;
};

std::vector<Object> make_clutter(const ClutterOptions& options);

// The boards around the sand and the walls of the hall.
std::vector<Object> make_hall(double half_length_m, double half_width_m);

}  // namespace dottrack::host_sim
