#pragma once
// How the vehicle moves, from two poses.

#include "app/core/tick_result.h"
#include "hal/base/time.h"

namespace dottrack::estimation {

// The mean motion between two poses of one lock: the difference of the positions, and the rotation
// vector from one attitude to the other, by the time between their captures. Not known where no
// time has passed. Noise of the poses goes into it by sqrt(2) over that time.
core::Motion motion_between(const core::Pose& before, Time captured_before, const core::Pose& now,
                            Time captured_now);

}  // namespace dottrack::estimation
