#pragma once
// Who sees what: the simulator's own answer, from geometry alone.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

inline constexpr double kSmallestDot_px = 3.0;  // across, where it is widest

// Whether a point shows at least `margin_px` inside the picture, if nothing stands before it.
bool in_picture(const SimCamera& camera, const Eigen::Vector3d& p_world, double margin_px = 0.0);

// How many cameras have this point in their pictures.
int cameras_on(std::span<const SceneCamera> cameras, const Eigen::Vector3d& p_world,
               double margin_px = 0.0);

// The middle of the dots, vehicle coordinates.
Eigen::Vector3d middle_of(const TargetLayout& target);

// For every dot, how many cameras truly see it at a time: it faces them, shows whole and at least
// kSmallestDot_px wide in the picture, and neither the hall nor a body hides its middle or more
// than a quarter of its edge. `vehicle`: T_world_vehicle.
std::vector<int> views_of_dots(std::span<const SceneCamera> cameras, const TargetLayout& target,
                               const Pose& vehicle, const Hall& hall,
                               std::span<const MovingBody> bodies, double time_s);

// How many of those are seen by two cameras or more: fewer than three, and there is nothing to lock
// on to.
int dots_in_two_views(std::span<const int> views);

}  // namespace dottrack::host_sim
