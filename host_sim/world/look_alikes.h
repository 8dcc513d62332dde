#pragma once
// Loose things that may be taken for dots, and some that may not.

#include <cstdint>

#include "host_sim/world/model.h"

namespace dottrack::host_sim {

// One thing, standing on z = 0 about the origin, within 0.4 m of it: a plate with a bright disc, a
// ball, a cup, a lid, a box with a label, a stone.
Model make_look_alike(std::uint64_t seed);

}  // namespace dottrack::host_sim
