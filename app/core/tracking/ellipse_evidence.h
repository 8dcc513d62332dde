#pragma once
// What the shapes of the dots' regions say of a pose (paper section 3.3).

#include "app/core/rig.h"
#include "app/core/tracking/follow.h"

namespace dottrack::tracking {

// Natural logarithm of how much more probably the dots that were followed look as they do in this
// pose than regions of clutter of their size in the same places would. A sum over the views used of
// the dots that have a normal; 0 where none has. A dot counts for at most kMostDotLogOdds: what
// looks like a flat disc to one camera often looks so to the next.
inline constexpr double kMostDotLogOdds = 3.0;

double ellipse_log_odds_of(const core::Rig& rig, const core::Pose& pose,
                           const FollowResult& followed);

}  // namespace dottrack::tracking
