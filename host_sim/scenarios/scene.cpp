#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

std::optional<Pose> truth(const Scene& scene, double time_s) {
  if (!scene.vehicle) return std::nullopt;
  return scene.world.bodies[*scene.vehicle].motion(time_s);
}

}  // namespace dottrack::host_sim
