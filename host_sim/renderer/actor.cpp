#include "host_sim/renderer/actor.h"

#include <algorithm>
#include <utility>

namespace dottrack::host_sim {

Actor make_actor(int number, const RayScene& scene, std::vector<Pose> poses) {
  Actor actor{number, &scene, std::move(poses), {}};
  actor.reach.middle = actor.poses[actor.poses.size() / 2].to_world(scene.middle());
  double travel_m = 0.0;
  for (const Pose& pose : actor.poses) {
    travel_m = std::max(travel_m, (pose.to_world(scene.middle()) - actor.reach.middle).norm());
  }
  actor.reach.radius_m = scene.radius_m() + travel_m;
  return actor;
}

}  // namespace dottrack::host_sim
