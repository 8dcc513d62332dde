#pragma once
// One camera fitted alone to the dots it sees: where the adjustment of all starts.

#include <optional>
#include <span>

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/setup.h"

namespace dottrack::calibrate {

struct LoneFit {
  NumberedCamera camera;
  double scale = 1.0;  // of all sigmas, by which the residuals are what they may be
};

// Robust from wide to narrow. Nothing where it does not settle.
std::optional<LoneFit> fit_alone(const AdjustedCamera& camera, std::span<const View> views,
                                 std::span<const AdjustedDot> dots);

}  // namespace dottrack::calibrate
