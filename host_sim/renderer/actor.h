#pragma once
// A model in its place during one exposure, or one instant of it.

#include <cstddef>
#include <vector>

#include "host_sim/renderer/ball.h"
#include "host_sim/renderer/ray_scene.h"
#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

// What a line of sight may meet, by number: the actor's and its part's.
inline constexpr int kNothing = -1;
inline constexpr int kHall = 0;       // number of the actor that stands still
inline constexpr int kFirstBody = 1;  // of the first that may move
inline constexpr int kPartsOfActor = 1 << 16;

constexpr int thing_of(int actor, int part) {
  return actor * kPartsOfActor + part;
}
constexpr int actor_of(int thing) {
  return thing / kPartsOfActor;
}
constexpr int part_of(int thing) {
  return thing % kPartsOfActor;
}

struct Actor {
  int number = 0;
  const RayScene* scene = nullptr;
  std::vector<Pose> poses;  // one; or, behind a rolling shutter, one for each row of the picture
  Ball reach;               // around it in all these poses

  const Pose& pose(int row) const {
    return poses[poses.size() == 1 ? 0 : static_cast<std::size_t>(row)];
  }
};

Actor make_actor(int number, const RayScene& scene, std::vector<Pose> poses);

}  // namespace dottrack::host_sim
