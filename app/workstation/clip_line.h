#pragma once
// The part of a line that lies in a rectangle (Liang and Barsky 1984).

#include <Eigen/Core>
#include <algorithm>

namespace dottrack::workstation {

// Cuts the line from a to b to the rectangle; false when no part of it lies inside or when a
// coordinate is not finite.
inline bool clip_line(const Eigen::Vector2d& min, const Eigen::Vector2d& max, Eigen::Vector2d& a,
                      Eigen::Vector2d& b) {
  if (!a.allFinite() || !b.allFinite()) return false;
  const Eigen::Vector2d start = a;
  const Eigen::Vector2d along = b - a;
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (start[axis] < min[axis] || start[axis] > max[axis]) return false;
      continue;
    }
    const double to_min = (min[axis] - start[axis]) / along[axis];
    const double to_max = (max[axis] - start[axis]) / along[axis];
    enter = std::max(enter, std::min(to_min, to_max));
    leave = std::min(leave, std::max(to_min, to_max));
  }
  if (enter > leave) return false;
  a = start + enter * along;
  b = start + leave * along;
  return a.allFinite() && b.allFinite();
}

}  // namespace dottrack::workstation
