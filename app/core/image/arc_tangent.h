#pragma once
// The angle of a vector to 2e-8 rad: faster than the C library's and, unlike that, the same bits on
// every machine.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace dottrack::image {

// atan(t) for 0 <= t <= 1, to 2e-8 (Abramowitz and Stegun 4.4.49).
inline double arc_tangent_to_one(double t) {
  const double z = t * t;
  double series = 0.0028662257;
  for (const double c : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528, 1.0}) {
    series = series * z + c;
  }
  return t * series;
}

// As std::atan2, but 0 for the zero vector whatever its signs. The octant is looked up: it cannot
// be predicted.
inline double arc_tangent(double y, double x) {
  constexpr double kPi = std::numbers::pi;
  struct Octant {
    double start, sign;
  };
  static constexpr Octant kOctants[2][2] = {{{0.0, 1.0}, {kPi, -1.0}},
                                            {{kPi / 2, -1.0}, {kPi / 2, 1.0}}};
  const double wide = std::max(std::abs(x), std::abs(y));
  if (wide == 0.0) return 0.0;
  const double angle = arc_tangent_to_one(std::min(std::abs(x), std::abs(y)) / wide);
  const bool steep = std::abs(y) > std::abs(x);
  const Octant& octant = kOctants[static_cast<std::size_t>(steep)][static_cast<std::size_t>(x < 0)];
  return std::copysign(octant.start + octant.sign * angle, y + 0.0);  // -0 counts as 0
}

}  // namespace dottrack::image
