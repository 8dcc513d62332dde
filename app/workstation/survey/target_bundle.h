#pragma once
// Where a target's dots are on the vehicle, learned from a recorded run: the paper blames bad
// surveying of its dots for loosened tolerances (section 4).

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "app/core/rig.h"
#include "app/workstation/survey/run_file.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct LearnedDot {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // vehicle coordinates
  Eigen::Vector3d moved_m = Eigen::Vector3d::Zero();     // from where the rig's target has it
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();
  std::size_t views = 0;
};

struct LearnedTarget {
  std::vector<LearnedDot> dots;
  // Of all dots' coordinates, relative to each other: three rows a dot. The six directions in which
  // they would all move together are empty.
  Eigen::MatrixXd covariance;
  std::size_t ticks = 0;
  std::size_t views = 0;
  double rms_px = 0.0;  // of a coordinate of a view
};

// Adjusts the dots and the vehicle's pose in every tick together, so that the dots show where the
// cameras saw them (robustly, with the eccentricity of round dots); the cameras are taken as they
// are. Pictures do not say where on the vehicle its origin is: the learned dots lie on the given
// ones as well as a rigid motion can lay them. An error says which dot was seen too rarely.
Result<LearnedTarget> learn_target(const core::Rig& rig, std::span<const RecordedTick> ticks);

}  // namespace dottrack::workstation
