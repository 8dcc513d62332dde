#pragma once
// What is there, and what happens to it.

#include <string>
#include <vector>

#include "host_sim/world/lamp.h"
#include "host_sim/world/model.h"
#include "host_sim/world/motion.h"

namespace dottrack::host_sim {

// Something that may move: the vehicle, a person, a crate that somebody carries.
struct Body {
  std::string name;
  Model model;
  Motion motion;
};

struct World {
  Model hall;  // all that stands still, world coordinates
  std::vector<Lamp> lamps;
  LightPlan light;
  std::vector<Body> bodies;
};

}  // namespace dottrack::host_sim
