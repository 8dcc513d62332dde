#pragma once
// Random places, clutter and light, for acquisitions one after another in one hall.

#include <cstdint>
#include <optional>
#include <vector>

#include "host_sim/renderer/ray_scene.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// What differs from the scene it was drawn for. Everything stands still.
struct Placement {
  std::optional<Pose> vehicle;  // T_world_vehicle; where the scene has one
  std::vector<Body> bodies;     // the vehicle first, then what is around it
  LightPlan light;
  double opening = 1.0;  // of every iris: where its own control has settled in this light
};

// The index-th of a seed, a pure function of the arguments: the scene's vehicle anywhere in the
// sandbox where nothing of the hall stands (as long as such a place is found), heading anywhere;
// look-alikes, people and crates around it; lamps dimmed, at times the sun. Of a scene without a
// vehicle: all that around nothing. `hall` is the scene's, ready for rays.
Placement random_placement(const Scene& base, const RayScene& hall, std::uint64_t seed,
                           std::uint64_t index);

}  // namespace dottrack::host_sim
