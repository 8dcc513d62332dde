#pragma once
// How the dots are lit: the simulator's own answer.

#include <span>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/world/lamp.h"

namespace dottrack::host_sim {

// Radiance of a white disc in a dot's place, from its middle and eight points of its edge.
struct DotLight {
  double darkest = 0.0;
  double brightest = 0.0;
};

// In the order of the target, at a time. `vehicle`: T_world_vehicle.
std::vector<DotLight> light_on_dots(const TargetLayout& target, const Pose& vehicle,
                                    const Hall& hall, std::span<const MovingBody> bodies,
                                    const LightPlan& light, double time_s);

// Whether no shadow's edge cuts the dot in two, and it stays well above the least grey level that
// the tracker takes for a dot's (appearance.intensity_min_dn) in the middle of the scene's dimmest
// picture. `opening`: of the irises.
bool well_lit(const DotLight& dot, const Scene& scene, double opening);

}  // namespace dottrack::host_sim
