#pragma once
// Trajectories in TUM order, one pose a line: `t x y z qx qy qz qw`; seconds, metres, Hamilton,
// body to world. Lines that start with # are comments.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "hal/base/result.h"

namespace dottrack::workstation {

struct TimedPose {
  double time_s = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // normalised when read
};

// In the file's order. An error names file, line and what was expected; times must increase.
Result<std::vector<TimedPose>> read_tum(const std::filesystem::path& file);

}  // namespace dottrack::workstation
