#pragma once
// What is there.

#include <optional>
#include <vector>

#include "host_sim/world/drive_path.h"
#include "host_sim/world/ground.h"
#include "host_sim/world/lighting.h"
#include "host_sim/world/object.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {

struct World {
  Ground ground;
  Lighting lighting;
  std::vector<Object> objects;     // that stand still; world coordinates
  std::optional<Vehicle> vehicle;  // absent: an empty scene
  DrivePath drive;                 // of the vehicle
};

}  // namespace dottrack::host_sim
