#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

SimCamera moved(const SimCamera& camera, const CameraMove& move) {
  return {camera.centre_m() + move.shift_m, turn(move.turn_rad).transpose() * camera.rotation(),
          camera.lens(), camera.width_px(), camera.height_px()};
}

std::optional<Pose> truth(const Scene& scene, double time_s) {
  if (!scene.vehicle) return std::nullopt;
  return scene.world.bodies[*scene.vehicle].motion(time_s);
}

}  // namespace dottrack::host_sim
