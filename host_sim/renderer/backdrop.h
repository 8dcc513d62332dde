#pragma once
// The picture of everything that stands still, as one camera sees it: rendered once.

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/still_life.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

struct Backdrop {
  FloatImage key;     // Radiance::key of each pixel
  FloatImage rest;    // Radiance::rest
  FloatImage ground;  // share of the pixel that is ground: where the vehicle's shadow falls
};

Backdrop paint_backdrop(const World& world, const SimCamera& camera, const RayLattice& rays,
                        const StillLife& still);

}  // namespace dottrack::host_sim
