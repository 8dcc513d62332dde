#pragma once
// Elementary functions from the four operations alone: the same bits on every machine, which a C
// library does not promise. Good to a few units in the last place for |x| < 1e4.

namespace dottrack::host_sim {

inline constexpr double kPi = 3.141592653589793238462643383279502884;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180.0);
}

double sine(double radians);
double cosine(double radians);
double tangent(double radians);
double exponential(double x);  // |x| < 700
// The angle of the direction (x, y) from the x axis, (-pi, pi]; 0 for no direction at all.
double arc_tangent(double y, double x);

}  // namespace dottrack::host_sim
