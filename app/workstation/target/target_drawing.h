#pragma once
// A flat target true to scale, for printing, and as the file that a rig reads.

#include <string>

#include "app/core/rig.h"
#include "app/workstation/target/target_design.h"

namespace dottrack::workstation {

// An SVG whose units are millimetres: x to the right, y up, as seen from above. Panel with crop
// marks, dots, and in faint grey their numbers and the axes; below the panel a bar of known length.
// Bright dots are white on black, dark ones black on white.
std::string target_svg(const core::Target& target, const Panel& panel, core::Polarity polarity);

// target.csv with normals; dots are named by their order, from 0.
std::string target_csv(const core::Target& target);

// On what paper the drawing fits at its true size, and what to do where none is large enough.
std::string how_to_print(const Panel& panel);

}  // namespace dottrack::workstation
