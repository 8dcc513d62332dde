#pragma once
// Scenes to try the tracker on. The same options give the same scene on every machine.

#include <cstdint>

#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// A rover with five dots drives round an 8 x 6 m sandbox under six cameras, among rocks, boxes and
// discs that look like dots.
Scene make_demo_scene(std::uint64_t seed);

struct RandomSceneOptions {
  std::uint64_t seed = 1;
  bool with_vehicle = true;
  int dots = 4;  // 3 to 16
  int cameras = 6;
  int look_alikes = 12;
  int rocks = 16;
  int boxes = 4;
  int width_px = 640;
  int height_px = 480;
};

// A rover somewhere in the sandbox with dots at random places, heading anywhere and driving on.
Scene make_random_scene(const RandomSceneOptions& options);

}  // namespace dottrack::host_sim
