#pragma once
// What the ellipses of a candidate's regions say of it (paper section 3.3).

#include <span>

#include "app/core/acquisition/finalists.h"
#include "app/core/acquisition/match.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::acquisition {

// Natural logarithm of how much more probably this dot of the target, in this pose, shows the
// ellipses that the finalist's cameras see than clutter does. 0 for a dot without a normal.
double ellipse_log_odds_of_dot(std::span<const CameraView> views, const Finalist& finalist,
                               const core::TargetDot& dot, const core::Pose& pose);

}  // namespace dottrack::acquisition
