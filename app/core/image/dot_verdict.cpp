#include "app/core/image/dot_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dottrack::image {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kQuantisation_dn2 = 1.0 / 12.0;
constexpr double kShot_dn = 1.0 / 40.0;   // variance a grey level of signal: 40 electrons each
constexpr double kModelPart = 0.01;       // of the contrast: what no model of a dot is better than
constexpr double kParameters = 7.0;       // that the dot's own pixels determine
constexpr double kAsymmetryLimit = 18.5;  // of chi-square with 4 degrees: 1 in 1000
constexpr double kHarmonicsLimit = 13.8;  // with 2 degrees: 1 in 1000
constexpr double kLightLimit = 13.8;      // the same
constexpr double kMisfitSigmas = 3.5;
constexpr double kFaint = 5.0;  // contrast in units of the noise
constexpr double kBlurReach_px = 1.5;
constexpr double kOutlineSigmas = 3.0;
constexpr double kOutlinePart = 0.03;
constexpr double kOverexposed = 0.5;  // of what is allowed otherwise
constexpr double kOutline_px = 0.04;

// What the parameters take out of edge_chi2: five move the outline (a weight of phi, cubed over
// squared), one changes its blur and some of one its contrast.
constexpr double kEdgeLost = 5.0 * 0.326 + 0.217 + 0.15;

void set_axes(const Matrix2d& shape, DotFit& fit) {
  const double mean = 0.5 * shape.trace();
  const double difference = 0.5 * (shape(0, 0) - shape(1, 1));
  const double half = std::sqrt(difference * difference + shape(0, 1) * shape(0, 1));
  fit.semi_major_px = 1.0 / std::sqrt(std::max(mean - half, 1e-6));
  fit.semi_minor_px = 1.0 / std::sqrt(mean + half);
  // The major axis is where the form is smallest.
  fit.angle_rad = half > 0.0 ? 0.5 * std::atan2(-2.0 * shape(0, 1), -2.0 * difference) : 0.0;
}

// Variance of the fitted half width along a unit vector v at unit noise, times its square: w =
// sqrt(v^T A^-1 v), and with k = A^-1 v, dw = -k^T dA k / 2w.
double width_variance(const LeftOver& left, const Vector2d& k) {
  const Eigen::Vector3d by(k.x() * k.x(), 2.0 * k.x() * k.y(), k.y() * k.y());
  return std::max(by.dot(left.shape_covariance * by), 0.0) / 4.0;
}

const std::array<Vector2d, 4> kDirections{
    Vector2d{1.0, 0.0}, Vector2d{std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0},
    Vector2d{0.0, 1.0}, Vector2d{-std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0}};

// The largest difference in width from what was expected, in units of what is allowed; negative
// when the dot is smaller there.
double outline_misfit(const ExpectedOutline& expected, const LeftOver& left, const DotFit& fit) {
  const Matrix2d wanted_matrix =
      ellipse_matrix(expected.semi_major_px, expected.semi_minor_px, std::cos(expected.angle_rad),
                     std::sin(expected.angle_rad));
  double worst = 0.0;
  for (const Vector2d& v : kDirections) {
    const Vector2d k = left.per_shape * v;
    const double wanted = std::sqrt(v.dot(wanted_matrix * v));
    const double shown = std::sqrt(v.dot(k));
    const double sigma = fit.noise_dn * std::sqrt(width_variance(left, k)) / shown;
    const double off =
        (shown - wanted) / (kOutlineSigmas * sigma + kOutlinePart * wanted + kOutline_px);
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  return worst;
}

bool cut_by_border(const ImageView& image, const LeftOver& left, const DotFit& fit) {
  const double x = std::sqrt(left.per_shape(0, 0)) + kBlurReach_px;
  const double y = std::sqrt(left.per_shape(1, 1)) + kBlurReach_px;
  return fit.centre_px.x() - x < -0.5 || fit.centre_px.y() - y < -0.5 ||
         fit.centre_px.x() + x > image.width_px - 0.5 ||
         fit.centre_px.y() + y > image.height_px - 0.5;
}

// Sum of squares that noise and the model's own limits leave in the dot's pixels.
double expected_chi2(const LeftOver& left, const DotFit& fit) {
  const double shot = std::max(kShot_dn * fit.contrast_dn, 0.0) * left.area_px2;
  const double model = kModelPart * fit.contrast_dn;
  return std::max(left.pixels - kParameters, 1.0) *
         (left.ring_noise_dn2 + shot / std::max(left.pixels, 1) + model * model);
}

// By light: with a slope of it taken out.
bool is_misfit(const LeftOver& left, const DotFit& fit, bool by_light) {
  const double gain = by_light ? left.light.gain_dn2 : 0.0;
  const double freedom = std::max(left.pixels - kParameters, 1.0);
  const double limit = 1.0 + kMisfitSigmas * std::sqrt(2.0 / freedom);
  const double model = kModelPart * fit.contrast_dn;
  const double noise2 = fit.noise_dn * fit.noise_dn + model * model;
  return left.chi2_dn2 - gain > limit * expected_chi2(left, fit) ||
         left.asymmetry_dn2 - gain > (by_light ? kHarmonicsLimit : kAsymmetryLimit) * noise2 ||
         left.light.gain_dn2 - gain > kLightLimit * noise2;
}

DotFlaw misfit_flaw(const Region& region, const LeftOver& left) {
  if (region.saturated_px > 0) return DotFlaw::saturated;
  return left.covered_chi2_dn2 > 0.5 * left.chi2_dn2 ? DotFlaw::hidden : DotFlaw::merged;
}

DotFlaw outline_flaw(const Region& region, const LeftOver& left, const ExpectedOutline* expected,
                     const DotFit& fit) {
  if (expected == nullptr) return DotFlaw::none;
  const double off = outline_misfit(*expected, left, fit);
  const bool saturated = region.saturated_px > 0;
  if (std::abs(off) <= (saturated ? kOverexposed : 1.0)) return DotFlaw::none;
  if (saturated) return DotFlaw::saturated;
  return off < 0.0 ? DotFlaw::hidden : DotFlaw::merged;
}

DotFlaw flaw_of(const ImageView& image, const Region& region, const LeftOver& left,
                const ExpectedOutline* expected, const DotFit& fit) {
  if (cut_by_border(image, left, fit)) return DotFlaw::border;
  if (std::abs(fit.contrast_dn) < kFaint * fit.noise_dn) return DotFlaw::faint;
  if (is_misfit(left, fit, false)) return misfit_flaw(region, left);
  return outline_flaw(region, left, expected, fit);
}

bool light_explains(const Region& region, const LeftOver& left, const ExpectedOutline* expected,
                    const DotFit& fit) {
  return (fit.flaw == DotFlaw::hidden || fit.flaw == DotFlaw::merged) &&
         !is_misfit(left, fit, true) && outline_flaw(region, left, expected, fit) == DotFlaw::none;
}

}  // namespace

void describe(const Vector2d& centre_px, const OutlineModel& model, const LeftOver& left,
              DotFit& fit) {
  fit.centre_px = centre_px;
  set_axes(model.shape, fit);
  fit.background_dn = model.background_dn;
  fit.contrast_dn = model.contrast_dn;
  const double weight = left.length_px * model.blur_px;
  const double kept = std::max(weight - kEdgeLost, 0.25 * weight);
  const double noise2 = std::max(left.edge_chi2_dn2 / kept, kQuantisation_dn2);
  fit.noise_dn = std::sqrt(noise2);
  // The noise is itself uncertain; as of a Student's t, that widens the centre's distribution.
  const double freedom = std::max(2.0 * std::sqrt(std::numbers::pi) * kept, 4.0);
  fit.covariance_px2 = noise2 * freedom / (freedom - 2.0) * left.centre_covariance;
  fit.light.slope_per_px = left.light.slope_dn / fit.contrast_dn;
  fit.light.information_px2 = fit.contrast_dn * fit.contrast_dn / noise2 * left.light.information;
  fit.light.centre_by_slope_px2 = fit.contrast_dn * left.light.centre_by_slope;
  fit.misfit = std::sqrt(std::max(left.chi2_dn2, 0.0) / expected_chi2(left, fit));
}

void judge(const ImageView& image, const Region& region, const LeftOver& left,
           const ExpectedOutline* expected, DotFit& fit) {
  fit.flaw = flaw_of(image, region, left, expected, fit);
  if (fit.flaw == DotFlaw::none || fit.flaw == DotFlaw::faint) return;
  fit.light.explains = light_explains(region, left, expected, fit);
  fit.light.covariance_px2 = fit.covariance_px2;
  const double unsure_px = 0.25 * fit.semi_minor_px;
  fit.covariance_px2 += unsure_px * unsure_px * Matrix2d::Identity();
}

}  // namespace dottrack::image
