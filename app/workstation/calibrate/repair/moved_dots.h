#pragma once
// The dots in the pictures of a camera that has been moved too far for tracking to see them there.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "app/config/rig_file.h"
#include "app/workstation/survey/run_file.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct MovedDots {
  std::vector<workstation::RecordedTick> ticks;  // with the camera's views, as those of a moved one
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  // of most of them, from the old model
};

// Looks through `frames`/<camera>/<tick>.pgm for the target's dots, whose places the poses of
// `ticks` say: what lies equally far off in picture after picture while the vehicle moves. Views of
// this camera that the ticks have are not used. An error names the camera and what was not found.
Result<MovedDots> find_moved_dots(const config::RigConfig& rig, std::size_t camera,
                                  const std::vector<workstation::RecordedTick>& ticks,
                                  const std::filesystem::path& frames);

}  // namespace dottrack::calibrate
