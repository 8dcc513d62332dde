#include "host_sim/renderer/still_life.h"

namespace dottrack::host_sim {

StillLife::StillLife(std::span<const Object> objects, const SimCamera& camera,
                     const RayLattice& rays)
    : eye_(camera.centre_m()),
      objects_(objects, camera.centre_m(), {0, 0, camera.width_px(), camera.height_px()},
               [&](int x, int y) { return rays.corner(x, y); }) {}

SurfaceHit StillLife::cast(int x, int y, const Eigen::Vector3d& direction) const {
  SurfaceHit result;
  Hit hit{result.distance, Eigen::Vector3d::UnitZ()};
  if (direction.z() < 0.0) {
    hit.distance = -eye_.z() / direction.z();
    result.surface = kGround;
  }
  const int object = objects_.nearest(x, y, direction, hit);
  if (object >= 0) result.surface = kFirstObject + object;
  result.distance = hit.distance;
  result.normal = hit.normal;
  return result;
}

}  // namespace dottrack::host_sim
