#include "app/core/estimation/same_place.h"

#include <algorithm>

namespace dottrack::estimation {

bool same_place(const core::Target& target, const core::Pose& a, const core::Pose& b) {
  const double reach_m = core::largest_dot_diameter_m(target);
  return std::all_of(target.dots.begin(), target.dots.end(), [&](const core::TargetDot& dot) {
    const Eigen::Vector3d in_a = a.orientation * dot.position_m + a.position_m;
    const Eigen::Vector3d in_b = b.orientation * dot.position_m + b.position_m;
    return (in_a - in_b).squaredNorm() < reach_m * reach_m;
  });
}

}  // namespace dottrack::estimation
