#pragma once
// What a pixel shows, surface by surface.

#include <Eigen/Core>

#include "hal/base/static_vector.h"
#include "host_sim/renderer/surface.h"

namespace dottrack::host_sim {

// The part of a pixel that one surface covers, and where it is seen on the average.
struct Patch {
  int surface = kNothing;
  int looks = 0;
  double share = 0.0;  // of the pixel's area
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of the first look
  double distance = 0.0;
};

using Patches = StaticVector<Patch, 12>;

}  // namespace dottrack::host_sim
