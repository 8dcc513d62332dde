#pragma once
// A recorded run as a survey or a repair needs it: the poses, and where each camera saw each dot.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/config/rig_file.h"
#include "app/core/tick_result.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct RecordedView {
  std::size_t camera = 0;  // in the rig
  std::size_t dot = 0;     // of the target
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool moved = false;  // by a camera that was left out: the pose does not rest on it
};

struct RecordedTick {
  std::uint64_t tick = 0;
  core::Pose pose;  // without its covariance
  std::vector<RecordedView> views;
};

// The ticks with a pose of OUT/poses.csv as a run of this rig wrote it; `run`: the file, or the
// folder that has it. An error names the file, and the line or the column that is missing.
Result<std::vector<RecordedTick>> read_run(const std::filesystem::path& run,
                                           const config::RigConfig& rig);

}  // namespace dottrack::workstation
