#pragma once
// A calibration's figures as files for programs, and as a table for a person.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/halves.h"

namespace dottrack::calibrate {

// camera,dot,tick,x_px,y_px,off_x_px,off_y_px,holdout_x_px,holdout_y_px,used
std::string residuals_csv(std::span<const SurveyedDot> dots, const Calibration& calibration);

std::string figures_json(std::span<const SurveyedDot> dots, const Calibration& calibration,
                         const std::optional<HalfFigures>& tested,
                         std::span<const std::string> remarks);

std::string figures_table(const Calibration& calibration, const std::optional<HalfFigures>& tested,
                          std::span<const std::string> remarks);

}  // namespace dottrack::calibrate
