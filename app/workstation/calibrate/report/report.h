#pragma once
// A calibration for people: one HTML file that asks for nothing from a network.

#include <optional>
#include <span>
#include <string>

#include "app/workstation/calibrate/fit/calibration.h"

namespace dottrack::calibrate {

struct ReportRequest {
  std::string title = "Calibration";
  std::optional<double> map_height_m = std::nullopt;  // else the dots' median height
  std::vector<std::string> remarks = {};              // of what came before: reading, labelling
};

// Well-formed XML too.
std::string report_html(const Calibration& calibration, std::span<const SurveyedDot> dots,
                        const ReportRequest& request);

}  // namespace dottrack::calibrate
