#pragma once
// A simulated camera as a CAHVOR model in JPL's text format, every number with 17 digits.

#include <string>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

std::string cahvor_text(const SimCamera& camera, const std::string& comment);

}  // namespace dottrack::host_sim
