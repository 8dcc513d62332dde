#pragma once
// A layout of dots on a flat panel that is hard to mistake and tells the pose well.

#include <cstddef>
#include <cstdint>

#include "app/core/rig.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct Panel {
  double length_m = 0.0;  // along x
  double width_m = 0.0;   // along y
};

struct DesignRequest {
  std::size_t dots = 4;  // 3 to 16
  Panel panel;
  double diameter_m = 0.0;  // 0: up to 50 mm, as the panel has room
  double sigma_m = 0.002;   // expected error of a dot's place
  bool upright = true;
  std::uint64_t seed = 1;
};

// Of the diameters that suit: 50 mm, or less where the panel is small for so many dots.
double suitable_diameter_m(std::size_t dots, const Panel& panel);

// Room for the window that a dot's centre is measured in, three radii each way.
inline constexpr double kSpacing_diameters = 3.0;  // between centres
inline constexpr double kMargin_diameters = 1.5;   // from a centre to the panel's edge

// What is beyond this many times the needed misfit helps no more.
inline constexpr double kAmple = 4.0;

// Dots in z = 0, facing up, the origin in the panel's middle, on a grid of a millimetre (of a tenth
// on panels below 0.3 m). Many layouts are thrown, and the best of them improved dot by dot: the
// least misfit of all their relabellings, of four dots or more, is made large: up to kAmple times
// what tells them from the truth, and from there on the attitude is told better. The same request
// gives the same layout. An error where the dots do not fit.
Result<core::Target> design_target(const DesignRequest& request);

}  // namespace dottrack::workstation
