#pragma once
// Cameras under the ceiling of the hall, and the lenses that they have.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

struct CeilingOptions {
  std::uint64_t seed = 1;
  int cameras = 12;  // 2 to 16: the long sides in turn, and one at each end where there are 6
  int width_px = 640;
  int height_px = 480;
  double field_min_deg = 60.0;  // across the picture, before the lens's distortion
  double field_max_deg = 80.0;
  LensKind lens = LensKind::radial;
  double height_m = 5.0;
  double length_m = 22.0;  // of the sandbox
  double width_m = 9.0;
};

// Where a camera is and what it looks at.
struct CameraPlace {
  Eigen::Vector3d at_m;
  Eigen::Vector3d aim_m;
  double roll_rad = 0.0;
};

// Round the sandbox, just outside its boards, each looking inwards and down. Every one is a little
// different.
std::vector<CameraPlace> ceiling_places(const CeilingOptions& options);

// The camera of an index at a place; its lens is one of the options', a little different for every
// index and seed.
SimCamera ceiling_camera(const CeilingOptions& options, std::size_t index,
                         const CameraPlace& place);

}  // namespace dottrack::host_sim
