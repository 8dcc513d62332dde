#pragma once
// Whether two poses are one and the same, as far as the dots can tell.

#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::estimation {

// Both poses put every dot of the target where the other one does, to within a dot's diameter.
bool same_place(const core::Target& target, const core::Pose& a, const core::Pose& b);

}  // namespace dottrack::estimation
