#pragma once
// How a body moves: its pose at any instant, exact.

#include <functional>
#include <optional>

#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

// T_world_body at a time in seconds; nothing while the body is not in the hall. Pure: the same time
// gives the same pose, in any order and from any thread.
using Motion = std::function<std::optional<Pose>(double time_s)>;

}  // namespace dottrack::host_sim
