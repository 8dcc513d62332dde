#include "app/workstation/calibrate/fit/chi_square.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::calibrate {
namespace {

// log(erfc(x)), by its asymptotic series where the function itself is lost.
double log_erfc(double x) {
  if (x < 20.0) return std::log(std::erfc(x));
  return -x * x - std::log(x * std::sqrt(std::numbers::pi)) - 0.5 / (x * x);
}

}  // namespace

double surprise2(double sum) {
  return 0.5 * std::max(sum, 0.0);
}

double surprise3(double sum) {
  const double half = 0.5 * std::max(sum, 0.0);
  const double root = std::sqrt(half);
  const double tail = log_erfc(root);
  const double rest = std::log(2.0 * root / std::sqrt(std::numbers::pi)) - half;
  const double larger = std::max(tail, rest);
  return -(larger + std::log1p(std::exp(std::min(tail, rest) - larger)));
}

double as_sigmas(double surprise) {
  double low = 0.0;
  double high = std::sqrt(2.0 * surprise) + 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (-log_erfc(middle * std::numbers::sqrt2 / 2.0) < surprise ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace dottrack::calibrate
