#include "app/core/image/centre_information.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace dottrack::image {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Matrix42 = Eigen::Matrix<double, 4, 2>;

// A slope of a small dot's light is nearly a shift of the dot. What integrals along the outline
// leave of the difference is wrong by about this times (blur / radius)^2 of the whole; so much is
// added, and a small dot's slope of light counts for little.
constexpr double kBlurredLight = 8.0;

const double kRootPi = std::sqrt(std::numbers::pi);

}  // namespace

// Across an edge of blur s, by distance, the integral of (phi / s)^2 is 1 / (2 sqrt(pi) s), of e
// phi / s it is 1/2, and e - e^2 has s / sqrt(pi).
CentreInformation::CentreInformation(const OutlineModel& model, const Outline& outline,
                                     const OutlineIntegrals& integrals, const FitWindow& window)
    : area_(std::numbers::pi * outline.determinant), centre_slope_(model.contrast_dn * area_) {
  using Term = OutlineIntegrals;
  const double c = model.contrast_dn;
  Matrix2d normal_normal;
  normal_normal << integrals[Term::kNxx], integrals[Term::kNxy], integrals[Term::kNxy],
      integrals[Term::kNyy];
  per_scatter_ = window.scatter.inverse();
  const Matrix2d centre = c * c / (2.0 * kRootPi * model.blur_px) * normal_normal;
  covariance_ = (centre - centre_slope_ * centre_slope_ * per_scatter_).inverse();
}

Vector2d CentreInformation::centre_gradient(const OutlineModel& model, const ResidualSums& sums) {
  return model.contrast_dn / model.blur_px *
         (model.shape * Vector2d(sums[ResidualSums::kRwx], sums[ResidualSums::kRwy]));
}

CentreVector CentreInformation::step(const CentreVector& g) const {
  CentreVector step;
  step.centre = covariance_ * (g.centre - centre_slope_ * (per_scatter_ * g.slope));
  step.slope = per_scatter_ * (g.slope - centre_slope_ * step.centre);
  return step;
}

double CentreInformation::asymmetry(const OutlineModel& model, const Outline& outline,
                                    const ResidualSums& sums, const CentreVector& step) const {
  const ThirdIntegrals third = integrate_thirds(outline);
  const double c = model.contrast_dn;
  const double s = model.blur_px;
  const double edge = c * c / (2.0 * kRootPi * s);
  const Matrix2d light = 0.25 * area_ * outline.per_shape + area_ * s * s * Matrix2d::Identity();
  const double blurred = kBlurredLight * s * s * std::numbers::pi / area_;
  Matrix42 by_centre;
  by_centre << edge * third.third_normal, 0.5 * c * area_ * Matrix2d::Identity();
  Matrix42 by_slope;
  by_slope << c * third.third_place, light;
  Matrix4d information;
  information << edge * third.third_third, 0.5 * c * third.third_place,
      0.5 * c * third.third_place.transpose(),
      (1.0 + blurred) * light - s / kRootPi * third.place_place;
  const double scale = c / s;
  Vector4d left;
  left << scale * sums[ResidualSums::kRw3c], scale * sums[ResidualSums::kRw3s],
      sums[ResidualSums::kRex], sums[ResidualSums::kRey];
  left -= by_centre * step.centre + by_slope * step.slope;
  // Less the centre's and the slope's share.
  const Matrix42 own = by_centre - centre_slope_ * by_slope * per_scatter_;
  information -= by_slope * per_scatter_ * by_slope.transpose();
  information -= own * covariance_ * own.transpose();
  return left.dot(information.inverse() * left);
}

}  // namespace dottrack::image
