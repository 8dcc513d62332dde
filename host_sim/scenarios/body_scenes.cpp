#include "host_sim/scenarios/body_scenes.h"

namespace dottrack::host_sim {

BodyScenes::BodyScenes(std::span<const Body> bodies) {
  for (const Body& body : bodies) {
    scenes_.push_back(std::make_unique<RayScene>(body.model));
    moving_.push_back({scenes_.back().get(), &body.motion});
  }
}

}  // namespace dottrack::host_sim
