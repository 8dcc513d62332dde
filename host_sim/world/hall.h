#pragma once
// The hall around the sandbox and all that stands still in it.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host_sim/world/lamp.h"
#include "host_sim/world/model.h"
#include "host_sim/world/terrain.h"

namespace dottrack::host_sim {

struct HallOptions {
  double length_m = 22.0;  // of the sandbox, along x; the same as the terrain's
  double width_m = 9.0;
  double height_m = 6.0;  // of the walls
  std::uint64_t seed = 1;
  int rocks = 120;
  int look_alikes = 30;
  bool lander = true;
  bool furniture = true;
  int calibration_dots = 24;  // around the sandbox
  int calibration_boxes = 0;  // with a calibration dot on top, all over the sand
  // How far a point of the ground is from where the vehicle's middle comes: nothing is put in its
  // way. Not set: no drive.
  std::function<double(const Eigen::Vector2d&)> distance_to_drive_m;
};

// World coordinates. The walls stand 1.5 m outside the boards, but for the end at high x, where
// the sun of hall_lamps() shines in: there the hall goes on for 10 m. Windows and fixtures shine
// with the lamps that they belong to.
Model make_hall(const HallOptions& options, const Terrain& terrain, std::span<const Lamp> lamps);

// The middles of the large dots that the cameras are calibrated by, those on boxes last, in the
// order of the marks that make_hall() puts first.
std::vector<Eigen::Vector3d> calibration_dot_centres(const HallOptions& options,
                                                     const Terrain& terrain);

}  // namespace dottrack::host_sim
