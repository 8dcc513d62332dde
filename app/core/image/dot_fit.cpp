#include "app/core/image/dot_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/core/image/centre_information.h"
#include "app/core/image/dot_patch.h"
#include "app/core/image/dot_verdict.h"
#include "app/core/image/outline_sums.h"
#include "app/core/image/ring_sums.h"
#include "app/core/image/shape_information.h"
#include "app/core/image/uneven_ring.h"

namespace dottrack::image {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kMaxSemiMajor_px = 24.0;
constexpr double kMinSemiMinor_px = 0.5;
constexpr double kGrow_px = 2.75;  // how far outside the region blur still reaches
constexpr int kRounds = 2;
constexpr double kConverged = 1.0;  // what the last step took off the sum of squares, in noise
// Where the ground right around the dot begins and ends: things lie three pixels beside dots.
constexpr double kBlurred_px = 2.0;
constexpr double kNearest_px = 3.25;
constexpr double kLit_px = 1.6;   // as far out there is light of the dot
constexpr double kEdge_px = 0.8;  // where the outline may be
constexpr double kTail = 0.02;    // of the contrast: what blur puts outside of that
constexpr double kLeastTail_dn = 3.0;
constexpr double kUnevenRing = 0.025;  // of the contrast: more is not noise alone
constexpr double kOutliersPerPixel = 0.01;
// Lenses as they are: 0.65 px, with the pixel's own width.
constexpr double kUsualBlur_px = 0.71;
constexpr double kBlurSigma_px = 0.3;
constexpr double kAllBlur_px = 4.0;  // radius of dots that show it well
constexpr double kLeastBlurSigma_px = 0.02;
constexpr double kMinBlur_px = 0.35;
constexpr double kMaxBlur_px = 3.0;
// Of a change of outline and blur, in sums that are weighed with phi: the integral of phi^3 over
// that of phi^2 is 0.33, of z^2 phi^3 over that of z^2 phi^2 0.22.
constexpr double kEdgeShare = 0.22;
constexpr double kMaxGain = 20.0;  // in noise: above, the fit has not converged
constexpr double kMaxStrain = 0.6;
constexpr double kMinContrast_dn = 1.0;
constexpr double kQuantisation_dn2 = 1.0 / 12.0;

DotFit unfitted(const Region& region) {
  DotFit fit;
  fit.centre_px = region.centroid_px;
  fit.semi_major_px = region.semi_major_px;
  fit.semi_minor_px = region.semi_minor_px;
  fit.angle_rad = region.angle_rad;
  const double half_px = std::max(0.5 * region.semi_major_px, 1.0);
  fit.covariance_px2 = half_px * half_px * Matrix2d::Identity();
  return fit;
}

class Fitting {
 public:
  Fitting(const ImageView& image, const Region& region)
      : image_(image),
        region_(region),
        cosine_(std::cos(region.angle_rad)),
        sine_(std::sin(region.angle_rad)) {}

  bool run() {
    const double outer_px =
        std::min(4.0 + 0.8 * region_.semi_major_px, kMaxReach_px - region_.semi_major_px);
    const GrownEllipse inner(region_, cosine_, sine_, kGrow_px);
    const GrownEllipse outer(region_, cosine_, sine_, outer_px);
    const Patch patch = patch_around(image_, region_.centroid_px, outer);
    if (patch.columns() <= 0 || patch.rows() <= 0) return false;
    corner_ = Vector2d(patch.x_min, patch.y_min);
    const Vector2d middle = region_.centroid_px - corner_;
    PatchRows rows;
    rows.count = patch.rows();
    set_spans(outer, middle, patch.rows(), patch.columns(), rows.outer);
    set_spans(inner, middle, patch.rows(), patch.columns(), rows.inner);
    const Pixels pixels(image_, patch);
    if (!sum_up(pixels.view(), rows)) return false;
    set_window();
    if (!start()) return false;
    return iterate();
  }

  Vector2d centre_px() const { return corner_ + model_.centre; }
  const OutlineModel& model() const { return model_; }
  const LeftOver& left() const { return left_; }

 private:
  bool sum_up(const ImageView& patch, const PatchRows& rows) {
    RingMask mask;
    sums_ = sum_patch(patch, rows, mask);
    if (!fit(sums_.ring, plane_)) return false;
    const GreySums whole = sums_.ring;
    drop_outliers(patch, mask, rounded(plane_, noise_limit_dn(plane_)), sums_.ring);
    if (sums_.ring.n != whole.n && !fit(sums_.ring, plane_)) return false;
    return list_pixels(patch, rows, pixels_) &&
           (!is_uneven(whole) || take_own_ground(patch, rows, mask, whole));
  }

  // Of the middle to the ring's plane; negative: darker.
  double seen_contrast_dn() const {
    const Vector2d middle = region_.centroid_px - corner_;
    const double around_dn =
        plane_.at_origin + plane_.per_x * middle.x() + plane_.per_y * middle.y();
    return core_grey(region_.centroid_px) - around_dn;
  }

  // The dot's light adds to the ground, or takes from it: nothing else is off the other way.
  double tail_dn() const {
    const double contrast = seen_contrast_dn();
    return std::copysign(std::max(kTail * std::abs(contrast), kLeastTail_dn), contrast);
  }

  // Something else shows in the ring.
  bool is_uneven(const GreySums& whole) const {
    const auto outliers = static_cast<double>(whole.n - sums_.ring.n);
    return outliers > kOutliersPerPixel * static_cast<double>(whole.n) ||
           plane_.sigma > kUnevenRing * std::abs(seen_contrast_dn());
  }

  bool take_own_ground(const ImageView& patch, const PatchRows& rows, const RingMask& mask,
                       const GreySums& whole) {
    const auto spans_of = [&](double grow_px) {
      Spans spans;
      const GrownEllipse ellipse(region_, cosine_, sine_, grow_px);
      set_spans(ellipse, region_.centroid_px - corner_, rows.count, patch.width_px, spans);
      return spans;
    };
    find_own_ground(patch, {rows.count, spans_of(kNearest_px), spans_of(kBlurred_px)}, mask, whole,
                    plane_);
    sums_.ring = whole;
    drop_strangers(patch, rows, {spans_of(kLit_px), spans_of(kEdge_px), tail_dn()}, plane_, sums_,
                   pixels_);
    return fit(sums_.ring, plane_);
  }

  void set_window() {
    const auto both = [](std::int64_t dot, std::int64_t ring) {
      return static_cast<double>(dot + ring);
    };
    const GreySums& dot = sums_.dot;
    const GreySums& ring = sums_.ring;
    window_.count = both(dot.n, ring.n);
    window_.mean = Vector2d(both(dot.x, ring.x), both(dot.y, ring.y)) / window_.count;
    const double xy = both(dot.xy, ring.xy);
    window_.scatter << both(dot.xx, ring.xx), xy, xy, both(dot.yy, ring.yy);
    window_.scatter -= window_.count * window_.mean * window_.mean.transpose();
  }

  // Contrast from the dot's core, place and area from its light.
  bool start() {
    const GreySums& dot = sums_.dot;
    const auto above = [&](std::int64_t v, std::int64_t n, std::int64_t x, std::int64_t y) {
      return static_cast<double>(v) - plane_.at_origin * static_cast<double>(n) -
             plane_.per_x * static_cast<double>(x) - plane_.per_y * static_cast<double>(y);
    };
    const double light = above(dot.v, dot.n, dot.x, dot.y);
    if (dot.n == 0 || !(std::abs(light) >= 1e-6)) return false;
    const Vector2d middle = region_.centroid_px - corner_;
    Vector2d centre =
        Vector2d(above(dot.vx, dot.x, dot.xx, dot.xy), above(dot.vy, dot.y, dot.xy, dot.yy)) /
        light;
    if (!((centre - middle).norm() < 0.5 * region_.semi_minor_px)) centre = middle;
    const Vector2d at = corner_ + centre;
    model_.centre = centre;
    model_.slope_dn = {plane_.per_x, plane_.per_y};
    model_.background_dn = plane_.at_origin + model_.slope_dn.dot(centre);
    model_.contrast_dn = (core_grey(at) - model_.background_dn) / core_share();
    model_.blur_px = kUsualBlur_px;
    const double area = light / model_.contrast_dn;
    const double seen = std::numbers::pi * region_.semi_major_px * region_.semi_minor_px;
    if (!(std::abs(model_.contrast_dn) >= kMinContrast_dn) || !(area > 0.0)) return false;
    const double scale = std::clamp(area / seen, 0.5, 2.0);
    model_.shape =
        (scale * ellipse_matrix(region_.semi_major_px, region_.semi_minor_px, cosine_, sine_))
            .inverse();
    return true;
  }

  // How much of the core's 3 x 3 pixels the blurred dot covers: about what a Gaussian of their and
  // the blur's variance would have of a disc.
  double core_share() const {
    constexpr double kVariance_px2 = kUsualBlur_px * kUsualBlur_px + 2.0 / 3.0;
    return 1.0 - std::exp(-region_.semi_major_px * region_.semi_minor_px / (2.0 * kVariance_px2));
  }

  // Mean of the 3 x 3 pixels at a place.
  double core_grey(const Vector2d& at) const {
    const int x = static_cast<int>(std::lround(at.x()));
    const int y = static_cast<int>(std::lround(at.y()));
    int sum = 0;
    int count = 0;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image_.height_px - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image_.width_px - 1); ++i) {
        sum += image_.at(i, j);
        ++count;
      }
    }
    return count > 0 ? static_cast<double>(sum) / count : 0.0;
  }

  // Every second step takes its information on the shape from where the first one started. That is
  // enough unless the blur is far from the usual one, or the dot so small that blur and contrast
  // are hard to tell apart.
  bool iterate() {
    const double noise2 = std::max(plane_.sigma * plane_.sigma, kQuantisation_dn2);
    const double prior = noise2 * blur_prior();
    for (int round = 1; round <= kRounds; ++round) {
      ResidualSums sums;
      DerivativeSums derivatives;
      sum_derivatives(pixels_, model_, sums, derivatives);
      const ShapeInformation shape(model_, derivatives, window_.count, prior);
      if (!shape.ok() || !take(step(sums, shape, prior))) return false;
      sum_residuals(pixels_, model_, sums);
      const Step last = step(sums, shape, prior);
      set_left(sums, derivatives, last, noise2);
      left_.shape_covariance = shape.covariance().topLeftCorner<3, 3>();
      if (!take(last) || !determined()) return false;
      if (last.gain_dn2 <= kConverged * noise2) break;
    }
    return true;
  }

  // Cut off by the image's end, the ring may say too little.
  bool determined() const {
    const Matrix2d& covariance = left_.centre_covariance;
    return covariance.allFinite() && covariance(0, 0) > 0.0 && covariance(1, 1) > 0.0 &&
           covariance.determinant() > 1e-9 * covariance(0, 0) * covariance(1, 1);
  }

  // Information on the blur, at unit noise, from what lenses are like. Of dots below 8 px it is as
  // good as all there is: what they show of their blur cannot be told from their contrast and size.
  double blur_prior() const {
    const double radius2 = region_.semi_major_px * region_.semi_minor_px;
    const double share = std::min(1.0, radius2 / (kAllBlur_px * kAllBlur_px));
    const double sigma_px = std::max(kBlurSigma_px * share * share * share, kLeastBlurSigma_px);
    return 1.0 / (sigma_px * sigma_px);
  }

  struct Step {
    CentreInformation information;
    CentreVector centre;
    ShapeInformation::Vector shape;
    double gain_dn2;  // of the sum of squares
  };

  Step step(const ResidualSums& sums, const ShapeInformation& shape, double prior) const {
    CentreInformation information(model_, window_);
    CentreVector centre;
    ShapeInformation::Vector even = ShapeInformation::gradient(model_, sums);
    even[3] += prior * (kUsualBlur_px - model_.blur_px);
    centre.centre = information.centre_gradient(model_, sums);
    add_background(sums, centre.slope, even[5]);
    const CentreVector centre_step = information.step(centre);
    const ShapeInformation::Vector shape_step = shape.covariance() * even;
    const double gain = centre.centre.dot(centre_step.centre) +
                        centre.slope.dot(centre_step.slope) + even.dot(shape_step);
    return {information, centre_step, shape_step, gain};
  }

  // The ring's pixels have no part in the dot: their residuals follow from their sums.
  void add_background(const ResidualSums& sums, Vector2d& slope_gradient,
                      double& level_gradient) const {
    const GreySums& ring = sums_.ring;
    const Vector2d slope = model_.slope_dn;
    const double at_origin = model_.background_dn - slope.dot(model_.centre);
    const auto left = [&](std::int64_t v, std::int64_t n, std::int64_t x, std::int64_t y) {
      return static_cast<double>(v) - at_origin * static_cast<double>(n) -
             slope.x() * static_cast<double>(x) - slope.y() * static_cast<double>(y);
    };
    const double dot_r = sums[ResidualSums::kR];
    const double ring_r = left(ring.v, ring.n, ring.x, ring.y);
    const Vector2d ring_place(left(ring.vx, ring.x, ring.xx, ring.xy),
                              left(ring.vy, ring.y, ring.xy, ring.yy));
    const Vector2d dot_place(sums[ResidualSums::kRx], sums[ResidualSums::kRy]);
    level_gradient = dot_r + ring_r;
    slope_gradient = ring_place + dot_place + dot_r * model_.centre - level_gradient * window_.mean;
  }

  bool take(const Step& step) {
    const double at_mean =
        model_.background_dn + model_.slope_dn.dot(window_.mean - model_.centre) + step.shape[5];
    model_.centre += step.centre.centre;
    model_.slope_dn += step.centre.slope;
    model_.background_dn = at_mean + model_.slope_dn.dot(model_.centre - window_.mean);
    model_.contrast_dn += step.shape[4];
    model_.blur_px = std::clamp(model_.blur_px + step.shape[3], kMinBlur_px, kMaxBlur_px);
    change_shape(step);
    const Vector2d off = centre_px() - region_.centroid_px;
    return model_.shape.allFinite() && std::abs(model_.contrast_dn) >= kMinContrast_dn &&
           off.norm() <= 0.5 * region_.semi_major_px + 0.5;
  }

  // By a strain of the outline, which is closer to linear than A, and leaves it an ellipse.
  void change_shape(const Step& step) {
    const Matrix2d& root = step.information.root();
    Matrix2d change;
    change << step.shape[0], step.shape[1], step.shape[1], step.shape[2];
    Matrix2d strain = root.transpose() * change * root;
    strain *= std::min(1.0, kMaxStrain / std::max(strain.norm(), 1e-9));
    const Matrix2d strained = root * (Matrix2d::Identity() - 0.5 * strain);
    left_.per_shape = strained * strained.transpose();
    model_.shape = left_.per_shape.inverse();
  }

  void set_left(const ResidualSums& sums, const DerivativeSums& derivatives, const Step& step,
                double noise2) {
    left_.pixels = pixels_.count;
    left_.area_px2 = step.information.area_px2();
    left_.length_px = step.information.length_px();
    left_.ring_noise_dn2 = noise2;
    left_.chi2_dn2 = sums[ResidualSums::kRr] - step.gain_dn2;
    left_.covered_chi2_dn2 = sums[ResidualSums::kRre];
    left_.edge_chi2_dn2 =
        sums[ResidualSums::kRrp] - kEdgeShare * std::min(step.gain_dn2, kMaxGain * noise2);
    left_.asymmetry_dn2 = step.information.asymmetry(model_, sums, derivatives, step.centre);
    left_.light = step.information.light_slope(model_, sums, derivatives, step.centre);
    left_.centre_covariance = step.information.covariance();
  }

  const ImageView& image_;
  const Region& region_;
  double cosine_;  // of its angle
  double sine_;
  Vector2d corner_;
  PatchSums sums_;
  Plane plane_;
  FitWindow window_;
  OutlineModel model_;
  LeftOver left_;
  DotPixels pixels_;
};

}  // namespace

DotFit fit_dot(const ImageView& image, const Region& region, const ExpectedOutline* expected) {
  DotFit fit = unfitted(region);
  if (image.empty() || !region.centroid_px.allFinite() ||
      !(region.semi_major_px <= kMaxSemiMajor_px && region.semi_minor_px >= kMinSemiMinor_px &&
        region.semi_minor_px <= region.semi_major_px)) {
    return fit;
  }
  Fitting fitting(image, region);
  if (!fitting.run()) return fit;
  describe(fitting.centre_px(), fitting.model(), fitting.left(), fit);
  judge(image, region, fitting.left(), expected, fit);
  return fit;
}

}  // namespace dottrack::image
