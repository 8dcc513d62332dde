#include "app/core/geometry/radial.h"

#include <cmath>
#include <limits>

namespace dottrack::geometry {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A Newton step below this leaves an error of its square: under double precision.
constexpr double kLastStep = 1e-9;

// Where the slope first reaches zero, or infinity.
double fold_radius(const RadialPolynomial& p) noexcept {
  const double half_b = 1.5 * p.b;
  const double discriminant = half_b * half_b - 5.0 * p.a * p.c;
  if (discriminant < 0.0) return kInfinity;
  // The smaller positive root of a + 2 half_b s + 5 c s^2, without cancellation.
  const double denominator = std::sqrt(discriminant) - half_b;
  return denominator > 0.0 ? std::sqrt(p.a / denominator) : kInfinity;
}

// Plain Newton; true when it settled on the rising branch.
bool newton(const RadialPolynomial& p, double target, double guess, double& r) noexcept {
  double x = guess;
  for (int i = 0; i < 12; ++i) {
    const double slope = p.slope(x);
    if (!(slope > 0.0)) return false;
    const double step = (p.value(x) - target) / slope;
    x -= step;
    if (std::abs(step) <= kLastStep * std::abs(x)) {
      if (!(x >= 0.0) || !p.rises_to_square(x * x)) return false;
      r = x;
      return true;
    }
  }
  return false;
}

// Newton held inside a bracket that bisection shrinks: for starts from which plain Newton strays.
OpticsStatus bracketed(const RadialPolynomial& p, double target, double high, double& r) noexcept {
  double low = 0.0;
  double x = 0.5 * high;
  for (int i = 0; i < 200; ++i) {
    const double excess = p.value(x) - target;
    (excess > 0.0 ? high : low) = x;
    double next = x - excess / p.slope(x);
    if (!(next > low && next < high) || i % 3 == 2) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 4e-16 * x) {
      r = next;
      return OpticsStatus::ok;
    }
    x = next;
  }
  return OpticsStatus::not_converged;
}

// A radius whose value is above the target, on a branch that never folds; too small a one where
// the target is out of any reach.
double upper_end(const RadialPolynomial& p, double target) noexcept {
  double high = 1.0;
  for (int i = 0; i < 200 && p.value(high) <= target; ++i) high *= 2.0;
  return high;
}

}  // namespace

OpticsStatus invert(const RadialPolynomial& polynomial, double target, double guess,
                    double& r) noexcept {
  if (newton(polynomial, target, guess, r)) return OpticsStatus::ok;
  if (!(polynomial.a > 0.0)) return OpticsStatus::outside_domain;
  const double fold = fold_radius(polynomial);
  const bool folds = std::isfinite(fold);
  const double high = folds ? fold : upper_end(polynomial, target);
  if (!(polynomial.value(high) > target)) {
    return folds ? OpticsStatus::outside_domain : OpticsStatus::not_converged;
  }
  return bracketed(polynomial, target, high, r);
}

}  // namespace dottrack::geometry
