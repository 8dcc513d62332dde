#pragma once
// How well models that were fitted without a dot say where it is.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/workstation/calibrate/fit/adjustment.h"

namespace dottrack::calibrate {

struct HeldOut {
  std::vector<std::optional<Eigen::Vector2d>>
      off_px;  // of each view: seen less surveyed dot's image
  std::vector<std::optional<Eigen::Vector3d>> off_m;  // of each dot: triangulated less surveyed
};

// Every fold's dots are left out once; noise and editing are those of the whole adjustment.
HeldOut hold_out(const Adjustment& whole, std::size_t folds, unsigned threads);

}  // namespace dottrack::calibrate
