#include "host_sim/world/portable_math.h"

#include <cmath>
#include <cstdint>

namespace dottrack::host_sim {
namespace {

// pi/2 in two parts, the first short enough for an exact product with a small integer.
constexpr double kHalfPiHigh = 1.5707963267341256141662597656250;
constexpr double kHalfPiLow = 6.0771005065061926e-11;
constexpr double kLn2High = 0.693147180369123816490173339843750;
constexpr double kLn2Low = 1.9082149292705877e-10;

// Taylor series; |r| <= pi/4.
double sine_near_zero(double r) {
  const double q = r * r;
  double term = r;
  double sum = r;
  for (int k = 2; k <= 18; k += 2) {
    term *= -q / static_cast<double>(k * (k + 1));
    sum += term;
  }
  return sum;
}

double cosine_near_zero(double r) {
  const double q = r * r;
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; k <= 17; k += 2) {
    term *= -q / static_cast<double>(k * (k + 1));
    sum += term;
  }
  return sum;
}

struct Reduced {
  double remainder;
  std::int64_t quadrant;
};

Reduced reduce(double x) {
  const double k = std::floor(x * (2.0 / kPi) + 0.5);
  return {(x - k * kHalfPiHigh) - k * kHalfPiLow, static_cast<std::int64_t>(k) & 3};
}

double sine_in_quadrant(double r, std::int64_t quadrant) {
  switch (quadrant) {
    case 0:
      return sine_near_zero(r);
    case 1:
      return cosine_near_zero(r);
    case 2:
      return -sine_near_zero(r);
    default:
      return -cosine_near_zero(r);
  }
}

}  // namespace

double sine(double radians) {
  const Reduced reduced = reduce(radians);
  return sine_in_quadrant(reduced.remainder, reduced.quadrant);
}

double cosine(double radians) {
  const Reduced reduced = reduce(radians);
  return sine_in_quadrant(reduced.remainder, (reduced.quadrant + 1) & 3);
}

double tangent(double radians) {
  return sine(radians) / cosine(radians);
}

double arc_tangent(double y, double x) {
  const double wide = std::abs(x);
  const double high = std::abs(y);
  if (wide == 0.0 && high == 0.0) return 0.0;
  const bool steep = high > wide;
  const double q = steep ? wide / high : high / wide;
  double angle = q * (0.9724 - 0.1919 * q * q);  // within 0.005; each round takes its fifth power
  for (int round = 0; round < 2; ++round) {
    const double s = sine_near_zero(angle);
    const double c = cosine_near_zero(angle);
    const double tangent_left = (q * c - s) / (c + q * s);
    angle += tangent_left * (1.0 - tangent_left * tangent_left / 3.0);
  }
  if (steep) angle = 0.5 * kPi - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

double exponential(double x) {
  const double k = std::floor(x / (kLn2High + kLn2Low) + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double term = 1.0;
  double sum = 1.0;
  for (int i = 1; i <= 16; ++i) {
    term *= r / static_cast<double>(i);
    sum += term;
  }
  return std::ldexp(sum, static_cast<int>(k));
}

}  // namespace dottrack::host_sim
