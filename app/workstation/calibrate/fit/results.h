#pragma once
// From an adjustment to what is told of it.

#include <span>

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/fit/hold_out.h"
#include "app/workstation/calibrate/fit/information.h"
#include "app/workstation/calibrate/fit/model_choice.h"

namespace dottrack::calibrate {

struct Finished {
  const Adjustment& adjustment;
  const Information& information;
  const HeldOut& held_out;
  std::span<const Choice> choices;  // of each camera
};

Calibration results_of(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                       const Finished& finished);

}  // namespace dottrack::calibrate
