#pragma once
// A simulated camera as a model in JPL's text format, every number with 17 digits: a pinhole as
// CAHV, a radial lens as CAHVOR, a fish-eye as CAHVORE.

#include <string>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

// `comment`: one line.
std::string camera_text(const SimCamera& camera, const std::string& comment);

}  // namespace dottrack::host_sim
