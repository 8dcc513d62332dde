#pragma once
// Uneven light on a dot: the soft edge of a shadow, a lamp close by. It brightens one side of the
// dot and so moves its centre the same way in every camera, which no residual shows.

#include <array>

#include "app/core/rig.h"
#include "app/core/tracking/expected_dot.h"
#include "app/core/tracking/seen_dots.h"

namespace dottrack::tracking {

using PlacedDots = std::array<PlacedDot, core::kMaxDots>;

// The slope of the light on each dot whose normal is known and which two cameras or more show, from
// all of these: weighted least squares of what each fit says of it (image::DotLight), in the dot's
// own plane. Takes the shift that it means out of the dot's views, as far as the slope is more than
// noise, and adds to their covariances what is unsure of it, all views alike. `placed`: the dots as
// expected.
void take_out_uneven_light(const core::Rig& rig, const PlacedDots& placed, SeenDots& seen);

}  // namespace dottrack::tracking
