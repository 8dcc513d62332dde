#pragma once
// How well models do on dots that they were not made from: fit on every other dot, test on the
// rest.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/views.h"

namespace dottrack::calibrate {

// Dots by their place in the survey, counted from 1.
enum class Half : std::uint8_t { odd, even };

bool is_in(Half half, std::size_t dot);

// The views with the dots of one half only.
std::vector<CameraViews> half_of(std::span<const CameraViews> views, Half half);

struct HalfFigures {
  double rms_px = 0.0;  // distances of pixels and projected dots, root mean square
  std::size_t observations = 0;
  double rms_m = 0.0;  // of dots triangulated from all cameras that see them, weights 1 / range^2
  std::size_t triangulated = 0;
};

// Of the dots of one half, as surveyed.
HalfFigures figures_of(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                       const Calibration& calibration, Half half);

}  // namespace dottrack::calibrate
