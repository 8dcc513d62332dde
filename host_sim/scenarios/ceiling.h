#pragma once
// Cameras under the ceiling of a hall.

#include <cstdint>
#include <vector>

#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

struct CeilingOptions {
  std::uint64_t seed = 1;
  int cameras = 6;  // 1 to 8: the corners first, then the middles of the long and the short sides
  int width_px = 640;
  int height_px = 480;
  double half_length_m = 4.0;  // of the floor they look at
  double half_width_m = 3.0;
  double height_m = 5.0;
};

// Every camera a little different: place, aim, roll, lens of 62 to 76 degrees, exposure.
std::vector<SceneCamera> ceiling_cameras(const CeilingOptions& options);

// The hall's lamps; 1 is a white surface in the brightest place, or a little less.
Lighting hall_lighting(std::uint64_t seed);

}  // namespace dottrack::host_sim
