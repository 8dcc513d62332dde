#pragma once
// How straight a line of measured positions is: the paper's measure of relative accuracy (section
// 4).

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace dottrack::workstation {

// Deviations from the straight line that fits the points best (least squares, at right angles).
struct Straightness {
  std::size_t points = 0;
  double horizontal_rms_m = 0.0;  // across the line, level
  double vertical_rms_m = 0.0;    // across the line and the level direction
  double rms_m = 0.0;             // both together
  double max_m = 0.0;
};

// All zero for fewer than three points. The line must not be vertical.
Straightness straightness_of(std::span<const Eigen::Vector3d> positions_m);

// Several runs together: RMS over all their points.
Straightness together(std::span<const Straightness> runs);

}  // namespace dottrack::workstation
