#include "app/core/image/shape_information.h"

namespace dottrack::image {

// The derivatives are -c/2s w (x^2, 2 x y, y^2), -c/s p z, e and 1.
ShapeInformation::ShapeInformation(const OutlineModel& model, const DerivativeSums& sums,
                                   double pixels, double blur_prior) {
  using Term = DerivativeSums;
  const double edge = model.contrast_dn / model.blur_px;
  const double half = -0.5 * edge;
  const double quarter = 0.25 * edge * edge;
  Matrix& m = covariance_;
  m(0, 0) = quarter * sums[Term::kWxxxx];
  m(0, 1) = 2.0 * quarter * sums[Term::kWxxxy];
  m(0, 2) = quarter * sums[Term::kWxxyy];
  m(1, 1) = 4.0 * quarter * sums[Term::kWxxyy];
  m(1, 2) = 2.0 * quarter * sums[Term::kWxyyy];
  m(2, 2) = quarter * sums[Term::kWyyyy];
  m(0, 3) = 2.0 * quarter * sums[Term::kPzwxx];
  m(1, 3) = 4.0 * quarter * sums[Term::kPzwxy];
  m(2, 3) = 2.0 * quarter * sums[Term::kPzwyy];
  m(3, 3) = 4.0 * quarter * sums[Term::kPzpz] + blur_prior;
  m(0, 4) = half * sums[Term::kEwxx];
  m(1, 4) = 2.0 * half * sums[Term::kEwxy];
  m(2, 4) = half * sums[Term::kEwyy];
  m(3, 4) = 2.0 * half * sums[Term::kPze];
  m(4, 4) = sums[Term::kEe];
  m(0, 5) = half * sums[Term::kWxx];
  m(1, 5) = 2.0 * half * sums[Term::kWxy];
  m(2, 5) = half * sums[Term::kWyy];
  m(3, 5) = 2.0 * half * sums[Term::kPz];
  m(4, 5) = sums[Term::kE];
  m(5, 5) = pixels;
  m.triangularView<Eigen::StrictlyLower>() = m.transpose();
  invert();
}

// By sweeping one row and column after the other; what is left of a pivot is what its parameter's
// predecessors do not explain.
void ShapeInformation::invert() {
  Matrix& m = covariance_;
  const Vector whole = m.diagonal();
  for (int k = 0; k < kParameters; ++k) {
    if (!(m(k, k) > 1e-6 * whole[k])) {
      ok_ = false;
      return;
    }
    const double per_pivot = 1.0 / m(k, k);
    const Vector column = m.col(k);
    m -= per_pivot * column * column.transpose();
    m.col(k) = per_pivot * column;
    m.row(k) = per_pivot * column.transpose();
    m(k, k) = -per_pivot;
  }
  m = -m;
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
