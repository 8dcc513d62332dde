#pragma once
// Plots of a simulated run that a person would want to see.

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

#include "app/workstation/truth_record.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

// What the hall looks like from above.
struct FloorPlan {
  double length_m = 0.0;  // of the sandbox, along x; its middle is the world's origin
  double width_m = 0.0;
  std::vector<Eigen::Vector2d> cameras_m;
};

// folder/path.svg (the hall from above), errors.svg (position and attitude over time), usage.svg
// (cameras and dots in use over time), cycle_times.svg (histogram).
Result<void> write_plots(std::span<const TruthRow> rows, const FloorPlan& plan,
                         const std::filesystem::path& folder);

}  // namespace dottrack::workstation
