#pragma once
// What one camera's picture says of one dot: the least that a pose is computed from.

#include <Eigen/Core>
#include <cstdint>

#include "app/core/limits.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {

struct DotObservation {
  std::uint8_t camera = 0;                                       // index in the rig
  std::uint8_t dot = 0;                                          // index in the target
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();           // of the dot's outline
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();  // of that centre
};

// A camera sees each dot once.
using DotObservations = StaticVector<DotObservation, kMaxCameras * core::kMaxDots>;

}  // namespace dottrack::estimation
