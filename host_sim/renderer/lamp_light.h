#pragma once
// What a lamp gives to a point, and how much of the lamp the point sees.

#include <Eigen/Core>
#include <array>
#include <bit>

#include "host_sim/renderer/ball.h"
#include "host_sim/world/lamp.h"

namespace dottrack::host_sim {

struct LampLight {
  explicit LampLight(const Lamp& lamp);

  Eigen::Vector3d normal;  // unit, of the side that shines
  Ball reach;              // around the lamp
  double strength;
  double bounce;
  // 16 points spread evenly over the lamp; so are the first four of them.
  std::array<std::array<Eigen::Vector3d, 4>, 4> points;
};

// Of a white surface with this unit normal, all of the lamp in sight: radiance.
double from_lamp(const LampLight& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal);

// The lamp's mirror image on a glossy surface; to_eye: unit. Multiply by the gloss.
double glint(const LampLight& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& to_eye);

// The share of the lamp in sight, by 4 of its points where they agree or where `finely` is not
// asked for, else by 16. hidden(four points): bit i is set where point i is hidden.
template <class Hidden>
double share_in_sight(const LampLight& lamp, bool finely, const Hidden& hidden) {
  const unsigned first = hidden(lamp.points[0]);
  int count = std::popcount(first);
  if (!finely || count == 0 || count == 4) return 1.0 - count / 4.0;
  for (std::size_t four = 1; four < 4; ++four) count += std::popcount(hidden(lamp.points[four]));
  return 1.0 - count / 16.0;
}

}  // namespace dottrack::host_sim
