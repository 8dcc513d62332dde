#pragma once
// The picture of everything that stands still, as one camera sees it: rendered once, light by
// light, with what it takes to put bodies and their shadows into it later.

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/lamp_light.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/ray_scene.h"
#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

// Distances in units of the line of sight's direction.
struct StillPoint {
  float nearest = std::numeric_limits<float>::infinity();  // of all that the pixel shows
  float farthest = 0.0F;
  float distance = std::numeric_limits<float>::infinity();  // of the face that covers most of it
  int thing = kNothing;                                     // that face
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

struct Glow {  // of a pixel that shows something that shines
  int x = 0;
  int y = 0;
  std::size_t lamp = 0;
  float radiance = 0.0F;  // at the lamp's level 1
};

struct Backdrop {
  std::vector<FloatImage> direct;  // by lamp, at level 1, shadows included
  FloatImage bounced;              // for a bounce of 1
  std::vector<Glow> glow;
  ImageBuffer<StillPoint> points;
};

// What stands still at the middle of a pixel, by its largest face.
Look still_look(const Backdrop& backdrop, const RayLattice& rays, int x, int y);

Backdrop paint_backdrop(const Actor& hall, std::span<const LampLight> lamps,
                        const SimCamera& camera, const RayLattice& rays);

}  // namespace dottrack::host_sim
