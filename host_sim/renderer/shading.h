#pragma once
// The light that a patch sends to the eye, lamp by lamp, before anything hides a lamp.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host_sim/renderer/actor.h"
#include "host_sim/renderer/lamp_light.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/ray_lattice.h"

namespace dottrack::host_sim {

// How a patch answers light.
struct Finish {
  double albedo = 0.0;
  double gloss = 0.0;
  double emission = 0.0;  // at level 1 of `lamp`
  int lamp = -1;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // world, with the material's relief
};

// footprint_m: the width of a pixel on the patch.
Finish finish_of(const Patch& patch, const Actor& actor, const Pose& pose, double footprint_m);

// How much of the bounced light a patch sends on: radiance for a lamp of bounce 1.
inline double bounced(const Finish& finish) {
  return finish.albedo * (0.6 + 0.4 * finish.normal.z());
}

// The radiance that each lamp would give the patch at level 1 with nothing in between.
void unshadowed(const Finish& finish, const Eigen::Vector3d& p, const Eigen::Vector3d& eye,
                std::span<const LampLight> lamps, std::vector<double>& radiance);

// The width of a pixel at distance 1, in units of its line of sight's direction.
inline double pixel_width(const RayLattice& rays, int x, int y) {
  return (rays.corner(x + 1, y).direction - rays.corner(x, y).direction).norm();
}

// Off the surface, so that it does not hide the lamps from itself.
inline Eigen::Vector3d off_surface(const Look& look) {
  constexpr double kOffSurface_m = 2e-3;
  return look.point + kOffSurface_m * look.normal;
}

}  // namespace dottrack::host_sim
