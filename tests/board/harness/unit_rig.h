#pragma once
// The rig file of the virtual board: the scene's, and what this board is wired to.

#include <filesystem>
#include <string>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::board {

// libcamera's id of the camera on a port (1 and up) of the emulated USB controller. It holds the
// firmware's name of the controller, the port, and vendor and product of the camera.
std::string camera_id(std::size_t port);

// folder/rig.toml, the camera models and the target.
Result<void> write_unit_rig(const host_sim::Scene& scene, const std::filesystem::path& folder);

// What the rig file says beyond the scene's. Not for others than the test.
std::string with_unit_keys(const host_sim::Scene& scene, const std::string& rig_toml);

}  // namespace dottrack::board
