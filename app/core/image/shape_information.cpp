#include "app/core/image/shape_information.h"

#include <cmath>
#include <numbers>

namespace dottrack::image {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastPivot = 1e-6;  // of the whole: what is left of a determined parameter

// By L D L^T of the lower triangle. False when a pivot says that a parameter follows from the ones
// before it; `whole` is the diagonal before anything was taken off.
bool invert(const Matrix3d& m, const Vector3d& whole, Matrix3d& inverse) {
  const double l10 = m(1, 0) / m(0, 0);
  const double l20 = m(2, 0) / m(0, 0);
  const double d1 = m(1, 1) - l10 * m(1, 0);
  const double e = m(2, 1) - l20 * m(1, 0);
  const double l21 = e / d1;
  const double d2 = m(2, 2) - l20 * m(2, 0) - l21 * e;
  if (!(m(0, 0) > kLeastPivot * whole[0] && d1 > kLeastPivot * whole[1] &&
        d2 > kLeastPivot * whole[2])) {
    return false;
  }
  const double corner = l10 * l21 - l20;  // of L^-1
  const double per_d1 = 1.0 / d1;
  const double per_d2 = 1.0 / d2;
  const double i10 = -l10 * per_d1 - corner * l21 * per_d2;
  const double i20 = corner * per_d2;
  const double i21 = -l21 * per_d2;
  inverse << 1.0 / m(0, 0) + l10 * l10 * per_d1 + corner * corner * per_d2, i10, i20, i10,
      per_d1 + l21 * l21 * per_d2, i21, i20, i21, per_d2;
  return true;
}

const double kPerRootPi = 1.0 / std::sqrt(std::numbers::pi);

}  // namespace

// The derivatives are -c/2s w (x^2, 2 x y, y^2), -c/s b, e and 1, with p = phi(z), e = Phi(z), w =
// p h / m and b = p (z + k / t m) (outline_sums.h). Along the ray of an angle z = (1 - m) / t,
// u^T A u = m^2 - k and dx dy = det(root) t m dz dangle: over z all the products are moments of
// phi, phi^2 and phi Phi, with 1 / m = 1 + t z + t^2 z^2.
ShapeInformation::ShapeInformation(const OutlineModel& model, const Outline& outline,
                                   const OutlineIntegrals& integrals, double pixels,
                                   double blur_prior) {
  using Term = OutlineIntegrals;
  const OutlineIntegrals& of = integrals;
  const double area = outline.determinant;
  const double once = -0.5 * model.contrast_dn * area;  // -c/2s, and s det(root) of w's integrals
  const double twice =
      0.25 * model.contrast_dn * model.contrast_dn / model.blur_px * area * (0.5 * kPerRootPi);
  const double edge = model.contrast_dn / model.blur_px;
  const double trace = model.blur_px * model.blur_px * model.shape.trace();
  const double inside = 2.0 * std::numbers::pi * (1.0 - trace) + 2.0 * of[Term::kTt];
  Matrix& m = information_;
  m(0, 0) = twice * of[Term::kXxxx];
  m(1, 0) = 2.0 * twice * of[Term::kXxxy];
  m(2, 0) = twice * of[Term::kXxyy];
  m(1, 1) = 4.0 * twice * of[Term::kXxyy];
  m(2, 1) = 2.0 * twice * of[Term::kXyyy];
  m(2, 2) = twice * of[Term::kYyyy];
  const double by_blur = 0.5 * kPerRootPi * edge * -once;
  m(3, 0) = by_blur * of[Term::kBxx];
  m(3, 1) = 2.0 * by_blur * of[Term::kBxy];
  m(3, 2) = by_blur * of[Term::kByy];
  m(3, 3) = 0.5 * kPerRootPi * edge * edge * area * of[Term::kBb] + blur_prior;
  m(4, 0) = once * (0.5 * of[Term::kXx] - kPerRootPi * of[Term::kTxx]);
  m(4, 1) = 2.0 * once * (0.5 * of[Term::kXy] - kPerRootPi * of[Term::kTxy]);
  m(4, 2) = once * (0.5 * of[Term::kYy] - kPerRootPi * of[Term::kTyy]);
  m(4, 3) = -edge * area * of[Term::kBe];
  m(4, 4) = area * (0.5 * inside - kPerRootPi * of[Term::kT]);
  m(5, 0) = once * of[Term::kXx];
  m(5, 1) = 2.0 * once * of[Term::kXy];
  m(5, 2) = once * of[Term::kYy];
  m(5, 3) = -edge * area * (2.0 * std::numbers::pi * trace - 2.0 * of[Term::kTt]);
  m(5, 4) = 0.5 * area * inside;
  m(5, 5) = pixels;
  m.triangularView<Eigen::StrictlyUpper>() = m.transpose();
  ok_ = invert();
}

// In halves: the outline's shape first, then blur and grey levels as far as that leaves them.
bool ShapeInformation::invert() {
  const Vector whole = information_.diagonal();
  const Matrix3d cross = information_.bottomLeftCorner<3, 3>();
  Matrix3d shape;
  if (!image::invert(information_.topLeftCorner<3, 3>(), whole.head<3>(), shape)) return false;
  const Matrix3d explained = cross * shape;
  Matrix3d rest = information_.bottomRightCorner<3, 3>();
  rest.noalias() -= explained * cross.transpose();
  Matrix3d covariance;
  if (!image::invert(rest, whole.tail<3>(), covariance)) return false;
  const Matrix3d by_rest = covariance * explained;
  covariance_.topLeftCorner<3, 3>() = shape;
  covariance_.topLeftCorner<3, 3>().noalias() += explained.transpose() * by_rest;
  covariance_.bottomLeftCorner<3, 3>() = -by_rest;
  covariance_.topRightCorner<3, 3>() = -by_rest.transpose();
  covariance_.bottomRightCorner<3, 3>() = covariance;
  return true;
}

ShapeInformation::Vector ShapeInformation::gradient(const OutlineModel& model,
                                                    const ResidualSums& sums) {
  const double edge = model.contrast_dn / model.blur_px;
  Vector g;
  g << -0.5 * edge * sums[ResidualSums::kRwxx], -edge * sums[ResidualSums::kRwxy],
      -0.5 * edge * sums[ResidualSums::kRwyy], -edge * sums[ResidualSums::kRb],
      sums[ResidualSums::kRe], 0.0;
  return g;
}

}  // namespace dottrack::image
