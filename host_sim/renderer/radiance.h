#pragma once
// What a surface sends to the eye; 1 = a white surface in full light. Kept in two parts, so that a
// shadow can be laid on later.

#include <Eigen/Core>

#include "host_sim/world/lighting.h"
#include "host_sim/world/object.h"

namespace dottrack::host_sim {

struct Radiance {
  double key = 0.0;   // from the key lamp
  double rest = 0.0;  // from everything else

  double total() const { return key + rest; }
};

// A point of a surface, as the eye sees it.
struct SurfacePoint {
  Eigen::Vector3d p_world;
  Eigen::Vector3d p_body;  // in the coordinates of the object's body, where its pattern lives
  Eigen::Vector3d normal;  // unit, world
  double footprint_m;      // width of a pixel there
};

Radiance radiance_of(const Material& material, const SurfacePoint& point, const Lighting& lighting,
                     const Eigen::Vector3d& eye);

}  // namespace dottrack::host_sim
