#include "host_sim/renderer/ball.h"

#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {

// Those lines fill the balls between the two, whose radius changes evenly; the one that comes
// nearest to `between` is found in closed form.
bool may_hide(const Ball& between, const Ball& seen, const Ball& lamp) {
  const Eigen::Vector3d axis = lamp.middle - seen.middle;
  const Eigen::Vector3d to_ball = between.middle - seen.middle;
  const double length = axis.norm();
  const double widening = lamp.radius_m - seen.radius_m;
  if (!(length > std::abs(widening))) return true;  // one holds the other
  const double slope = widening / length;
  const double along = to_ball.dot(axis) / length;
  const double across = std::sqrt(std::max(to_ball.squaredNorm() - along * along, 0.0));
  const double nearest = along + across * slope / std::sqrt(1.0 - slope * slope);
  const double at = std::clamp(nearest / length, 0.0, 1.0);
  const double gap = (to_ball - at * axis).norm() - (seen.radius_m + at * widening);
  return gap <= between.radius_m * 1.0001 + 1e-6;
}

}  // namespace dottrack::host_sim
