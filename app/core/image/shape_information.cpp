#include "app/core/image/shape_information.h"

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

}  // namespace

// The derivatives are -c/2s w (x^2, 2 x y, y^2), -c/s p z, e and 1.
ShapeInformation::ShapeInformation(const OutlineModel& model, const DerivativeSums& sums,
                                   double pixels, double blur_prior) {
  using Term = DerivativeSums;
  const double edge = model.contrast_dn / model.blur_px;
  const double half = -0.5 * edge;
  const double quarter = 0.25 * edge * edge;
  Matrix& m = covariance_;
  m(0, 0) = quarter * sums[Term::kWxxxx];
  m(1, 0) = 2.0 * quarter * sums[Term::kWxxxy];
  m(2, 0) = quarter * sums[Term::kWxxyy];
  m(1, 1) = 4.0 * quarter * sums[Term::kWxxyy];
  m(2, 1) = 2.0 * quarter * sums[Term::kWxyyy];
  m(2, 2) = quarter * sums[Term::kWyyyy];
  m(3, 0) = 2.0 * quarter * sums[Term::kPzwxx];
  m(3, 1) = 4.0 * quarter * sums[Term::kPzwxy];
  m(3, 2) = 2.0 * quarter * sums[Term::kPzwyy];
  m(3, 3) = 4.0 * quarter * sums[Term::kPzpz] + blur_prior;
  m(4, 0) = half * sums[Term::kEwxx];
  m(4, 1) = 2.0 * half * sums[Term::kEwxy];
  m(4, 2) = half * sums[Term::kEwyy];
  m(4, 3) = 2.0 * half * sums[Term::kPze];
  m(4, 4) = sums[Term::kEe];
  m(5, 0) = half * sums[Term::kWxx];
  m(5, 1) = 2.0 * half * sums[Term::kWxy];
  m(5, 2) = half * sums[Term::kWyy];
  m(5, 3) = 2.0 * half * sums[Term::kPz];
  m(5, 4) = sums[Term::kE];
  m(5, 5) = pixels;
  ok_ = invert();
}

// In halves: the outline's shape first, then blur and grey levels as far as that leaves them.
bool ShapeInformation::invert() {
  const Vector whole = covariance_.diagonal();
  const Matrix3d cross = covariance_.bottomLeftCorner<3, 3>();
  Matrix3d shape;
  if (!image::invert(covariance_.topLeftCorner<3, 3>(), whole.head<3>(), shape)) return false;
  const Matrix3d explained = cross * shape;
  Matrix3d rest = covariance_.bottomRightCorner<3, 3>();
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
      -0.5 * edge * sums[ResidualSums::kRwyy], -edge * sums[ResidualSums::kRpz],
      sums[ResidualSums::kRe], 0.0;
  return g;
}

}  // namespace dottrack::image
