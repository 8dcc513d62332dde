#include "app/core/image/centre_information.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
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
constexpr double kMostCurved = 0.5;

const double kRootPi = std::sqrt(std::numbers::pi);

// Half a turn in equal steps; the integrands are the same on the other half.
constexpr std::size_t kNodes = 8;
constexpr double kC1 = 0.92387953251128674;
constexpr double kC2 = 0.70710678118654752;
constexpr double kC3 = 0.38268343236508977;
constexpr std::array<std::array<double, 2>, kNodes> kCircle{{{1.0, 0.0},
                                                             {kC1, kC3},
                                                             {kC2, kC2},
                                                             {kC3, kC1},
                                                             {0.0, 1.0},
                                                             {-kC3, kC1},
                                                             {-kC2, kC2},
                                                             {-kC1, kC3}}};

Matrix2d lower_root(const Matrix2d& m) {
  Matrix2d root = Matrix2d::Zero();
  root(0, 0) = std::sqrt(m(0, 0));
  root(1, 0) = m(1, 0) / root(0, 0);
  root(1, 1) = std::sqrt(m(1, 1) - root(1, 0) * root(1, 0));
  return root;
}

Matrix2d symmetric(const DerivativeSums& sums, DerivativeSums::Term first) {
  Matrix2d m;
  m << sums.of[first], sums.of[first + 1], sums.of[first + 1], sums.of[first + 2];
  return m;
}

constexpr double kStep_rad = 2.0 * std::numbers::pi / kNodes;

Vector2d third_harmonics(const Vector2d& u) {
  const double x = u.x();
  const double y = u.y();
  return {x * x * x - 3.0 * x * y * y, 3.0 * x * x * y - y * y * y};
}

// A point of the outline, root e, and d place / d angle: its length is by how much a step of angle
// is longer along the outline. The normal is across it, and |A place| is that length over root's
// determinant.
struct OutlinePoint {
  OutlinePoint(const Matrix2d& root, const std::array<double, 2>& e)
      : place(root(0, 0) * e[0], root(1, 0) * e[0] + root(1, 1) * e[1]),
        across(root(1, 1) * e[0] - root(1, 0) * e[1], root(0, 0) * e[1]),
        speed(across.norm()) {}

  Vector2d place;
  Vector2d across;  // the normal times speed
  double speed;
};

// Along the outline, by length: h = 1 / |A u| times the third harmonics with each other, the normal
// and u.
struct ThirdIntegrals {
  explicit ThirdIntegrals(const Matrix2d& root) {
    const double determinant = root.determinant();
    for (const auto& e : kCircle) {
      const OutlinePoint at(root, e);
      const double h = determinant / at.speed;
      const Vector2d third = third_harmonics(at.place);
      const Vector2d third_step = kStep_rad * h * third;
      third_third += determinant * third_step * third.transpose();
      third_normal += third_step * at.across.transpose();
      third_place += kStep_rad * determinant * third * at.place.transpose();
    }
  }

  Matrix2d third_third = Matrix2d::Zero();
  Matrix2d third_normal = Matrix2d::Zero();
  Matrix2d third_place = Matrix2d::Zero();
};

}  // namespace

// Of a slope of the dot's light and one of the background: the second moments of the blurred dot.
Matrix2d CentreInformation::light_by_slope(const OutlineModel& model) const {
  return 0.25 * area_ * model.shape.inverse() +
         area_ * model.blur_px * model.blur_px * Matrix2d::Identity();
}

// Across an edge of blur s, by distance, the integral of (phi / s)^2 is 1 / (2 sqrt(pi) s), and of
// e phi / s it is 1/2.
CentreInformation::CentreInformation(const OutlineModel& model, const FitWindow& window) {
  integrate(model);
  const double c = model.contrast_dn;
  centre_slope_ = c * area_;
  per_scatter_ = window.scatter.inverse();
  const Matrix2d centre = c * c / (2.0 * kRootPi * model.blur_px) *
                          curved(model.blur_px * model.blur_px) * normal_normal_;
  covariance_ = (centre - centre_slope_ * centre_slope_ * per_scatter_).inverse();
}

// What a straight edge says too much: with q = blur^2 / radius^2, a disc has
// sqrt(pi / q) exp(-1 / 2q) I1(1 / 2q) of it, here by its series.
double CentreInformation::curved(double blur2_px2) const {
  const double q = std::min(blur2_px2 * std::numbers::pi / area_, kMostCurved);
  return 1.0 - q * (0.75 + 0.46875 * q);
}

void CentreInformation::integrate(const OutlineModel& model) {
  root_ = lower_root(model.shape.inverse());
  area_ = std::numbers::pi * root_.determinant();
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const auto& e : kCircle) {
    const OutlinePoint at(root_, e);
    const double per_speed = 1.0 / at.speed;
    length_ += kStep_rad * at.speed;
    xx += per_speed * at.across.x() * at.across.x();
    xy += per_speed * at.across.x() * at.across.y();
    yy += per_speed * at.across.y() * at.across.y();
  }
  normal_normal_ << kStep_rad * xx, kStep_rad * xy, kStep_rad * xy, kStep_rad * yy;
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

// From sums over the pixels throughout: of a small dot little is left of the information, and that
// little must not be the difference of two roundings.
LightSlope CentreInformation::light_slope(const OutlineModel& model, const ResidualSums& sums,
                                          const DerivativeSums& derivatives,
                                          const CentreVector& step) const {
  using Term = DerivativeSums;
  const double c = model.contrast_dn;
  const double blur2 = model.blur_px * model.blur_px;
  const Matrix2d to_centre = c / model.blur_px * model.shape;
  const Matrix2d slope_slope = light_by_slope(model);
  const Matrix2d light_centre =
      symmetric(derivatives, Term::kEwxx) * to_centre - centre_slope_ * slope_slope * per_scatter_;
  const Matrix2d centre_centre = to_centre * symmetric(derivatives, Term::kWwxx) * to_centre -
                                 centre_slope_ * centre_slope_ * per_scatter_;
  const Matrix2d by_light = centre_centre.inverse() * light_centre.transpose();
  LightSlope light;
  light.information = symmetric(derivatives, Term::kEexx) -
                      slope_slope * per_scatter_ * slope_slope - light_centre * by_light;
  Vector2d left(sums[ResidualSums::kRex], sums[ResidualSums::kRey]);
  left -= light_centre * step.centre +
          slope_slope * (step.slope + centre_slope_ * per_scatter_ * step.centre);
  light.slope_dn = light.information.inverse() * left;
  light.gain_dn2 = light.slope_dn.dot(left);
  light.centre_by_slope = by_light - blur2 / c * Matrix2d::Identity();
  return light;
}

double CentreInformation::asymmetry(const OutlineModel& model, const ResidualSums& sums,
                                    const DerivativeSums& derivatives,
                                    const CentreVector& step) const {
  const ThirdIntegrals third(root_);
  const Matrix2d light = light_by_slope(model);
  const double c = model.contrast_dn;
  const double edge = c * c / (2.0 * kRootPi * model.blur_px);
  const double blurred = kBlurredLight * model.blur_px * model.blur_px * std::numbers::pi / area_;
  Matrix42 by_centre;
  by_centre << edge * third.third_normal,
      0.5 * c * derivatives[DerivativeSums::kEe] * Matrix2d::Identity();
  Matrix42 by_slope;
  by_slope << c * third.third_place, light;
  Matrix4d information;
  information << edge * third.third_third, 0.5 * c * third.third_place,
      0.5 * c * third.third_place.transpose(),
      symmetric(derivatives, DerivativeSums::kEexx) + blurred * light;
  const double scale = c / model.blur_px;
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
