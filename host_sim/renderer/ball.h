#pragma once
// Bounding balls, and whether one may stand between two others.

#include <Eigen/Core>

namespace dottrack::host_sim {

struct Ball {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

// Whether a straight line from somewhere in `seen` to somewhere in `lamp` can touch `between`.
bool may_hide(const Ball& between, const Ball& seen, const Ball& lamp);

}  // namespace dottrack::host_sim
