#pragma once
// How much of the views' errors stays the same from tick to tick. A vehicle at rest shows the same
// shadows, surrounds and pixels again and again: what those do to a dot's centre no mean over ticks
// takes away.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/rig.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {

// What is left of a used view, in its own standard deviations.
struct ViewResidual {
  std::size_t camera = 0;
  std::size_t dot = 0;
  Eigen::Vector2d of = Eigen::Vector2d::Zero();
};

// From the correlation of each view's residual with its last one, over all views of some ticks, as
// far as it is more than chance.
class LastingShare {
 public:
  // The residuals of a tick's pose.
  void take_in(std::span<const ViewResidual> residuals);

  // Part of the views' variance: 0 when nothing lasts or nothing is known, at most 0.95.
  double value() const;

 private:
  struct Last {
    bool known = false;
    Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  };
  using LastOfAll = std::array<std::array<Last, core::kMaxDots>, kMaxCameras>;

  LastOfAll last_;
  double lasting_ = 0.0;  // sums of products of residuals, with the last ones
  double whole_ = 0.0;    // and of both with themselves
  double chance_ = 0.0;   // variance of the first, were nothing to last
};

}  // namespace dottrack::estimation
