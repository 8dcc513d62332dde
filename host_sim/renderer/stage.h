#pragma once
// All that stays the same from picture to picture of one camera.

#include <span>
#include <vector>

#include "host_sim/renderer/actor.h"
#include "host_sim/renderer/backdrop.h"
#include "host_sim/renderer/lamp_light.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/renderer/tile_index.h"

namespace dottrack::host_sim {

struct Stage {
  Stage(const RayScene& hall_scene, std::span<const Lamp> hall_lamps, const SimCamera& sim_camera)
      : camera(sim_camera),
        rays(camera),
        lamps(hall_lamps.begin(), hall_lamps.end()),
        hall(make_actor(kHall, hall_scene, {Pose{}})),
        backdrop(paint_backdrop(hall, lamps, camera, rays)),
        tiles(rays, backdrop) {}

  SimCamera camera;
  RayLattice rays;
  std::vector<LampLight> lamps;
  Actor hall;
  Backdrop backdrop;
  TileIndex tiles;
};

}  // namespace dottrack::host_sim
