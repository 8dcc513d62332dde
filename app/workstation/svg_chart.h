#pragma once
// Charts as SVG: lines, steps, points and bars on axes with round numbers.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dottrack::workstation {

enum class Style : std::uint8_t {
  line,    // from point to point; one that is not finite breaks the line
  steps,   // as a line, but level from each point to the next
  points,  // a mark each
  bars,    // from 0 to y, as wide as the distance to the next
};

struct Series {
  std::string label;   // empty: not in the legend
  std::string colour;  // as SVG has it: "#1f77b4"
  Style style = Style::line;
  std::vector<Eigen::Vector2d> points;
};

struct Chart {
  std::string title{};
  std::string x_label{};
  std::string y_label{};
  std::vector<Series> series{};
  bool y_from_zero = false;
  bool equal_scales = false;  // a metre is as long along x as along y: for maps
  double height_px = 260.0;   // of the axes; with equal scales it follows from the data
};

// The charts one below the other, as the text of an SVG file.
std::string svg(std::span<const Chart> charts);

// 1, 2 or 5 times a power of ten: the step that divides `range` into at most `most` parts.
double round_step(double range, int most);

}  // namespace dottrack::workstation
