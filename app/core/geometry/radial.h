#pragma once
// The odd polynomial of radial distortion, rho(r) = a r + b r^3 + c r^5, and its inverse on the
// branch that rises from zero. Shared by CAHVOR (r = tan of the angle) and CAHVORE (r = chi).

#include "app/core/geometry/optics_status.h"

namespace dottrack::geometry {

struct RadialPolynomial {
  double a = 1.0;
  double b = 0.0;
  double c = 0.0;

  double value(double r) const noexcept { return r * (a + r * r * (b + r * r * c)); }
  double slope(double r) const noexcept { return slope_at_square(r * r); }
  double slope_at_square(double r2) const noexcept { return a + r2 * (3.0 * b + r2 * 5.0 * c); }

  // Whether the slope is positive all the way from 0 to the root of r2: no fold before it.
  bool rises_to_square(double r2) const noexcept {
    if (!(a > 0.0) || !(slope_at_square(r2) > 0.0)) return false;
    const bool dips = b < 0.0 && 10.0 * c * r2 > -3.0 * b;  // the slope's minimum is inside
    return !dips || 9.0 * b * b < 20.0 * a * c;
  }
};

// The r >= 0 on the rising branch with rho(r) = target >= 0, to double precision.
// outside_domain: the branch ends (folds) below target. r is written only when ok.
OpticsStatus invert(const RadialPolynomial& polynomial, double target, double guess,
                    double& r) noexcept;

}  // namespace dottrack::geometry
