#pragma once
// Bodies made ready for rays to meet them.

#include <memory>
#include <span>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/renderer/ray_scene.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

class BodyScenes {
 public:
  // The bodies must outlive this and stay where they are in memory.
  explicit BodyScenes(std::span<const Body> bodies);

  std::span<const MovingBody> moving() const { return moving_; }

 private:
  std::vector<std::unique_ptr<RayScene>> scenes_;
  std::vector<MovingBody> moving_;
};

}  // namespace dottrack::host_sim
