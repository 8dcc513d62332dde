#include "app/core/estimation/dot_ellipse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::estimation {
namespace {

using geometry::ImageEllipse;

// How a dot's region differs from the ellipse of its disc, measured in the simulator over 2900
// views of dots (drive, people, occlusion and sun_blooming; true poses; semi-major axes of 2.2
// to 4.8 px, axis ratios of 0.33 to 0.8):
// - Threshold and blur make both axes longer by the same 0.3 to 0.6 px (1 % are shorter by 0.5 px
// or
//   more, being half hidden; on the real plate images dots are up to 1.45 times their size), so the
//   axes' difference says more than either of them.
// - That difference, as a vector along twice the axis's angle, is off by 0.2 px a coordinate and by
//   more than 1.2 px in 1 of 100 views. Blur adds 1.5 px^2 to both squared axes, which makes the
//   difference smaller for the smallest dots.
constexpr double kBlur_px2 = 1.5;

// The gate leaves room for the plate images and for a pose that is a tick old.
constexpr double kShrinkMajor = 0.7;
constexpr double kShrinkMinor = 0.6;
constexpr double kGrow = 1.5;
constexpr double kRim_px = 0.25;      // what hiding takes from an axis beyond that
constexpr double kGrowRim_px = 1.25;  // what blur and threshold add beyond that
constexpr double kOdd = 0.3;          // of the difference, in semi-major axes ...
constexpr double kOddRim_px = 1.0;    // ... and pixels

// The likelihoods. Clutter: among the 9000 regions in the same images that are no dots, the
// difference over the semi-major axis is spread evenly in angle (within a factor of 2.5: the edges
// of a hall lie level) and as a normal deviate of 0.39 a coordinate. Some clutter is as flat as the
// dots are: with a fifth of it so, the mean of exp(log odds) over regions of a dot's size that are
// none is 0.8 to 1.3, and that of exp(-log odds) over the dots 0.5 to 1.1; both should be at
// most 1.
constexpr double kSigma_px = 0.28;
constexpr double kOddPart = 0.02;  // dots half hidden, or grown together with something bright
constexpr double kClutterSigma = 0.39;
constexpr double kLikeDotsPart = 0.2;

bool within(double seen, double expected, double shrink) {
  return seen >= shrink * expected - kRim_px && seen <= kGrow * expected + kGrowRim_px;
}

// Squared distance of two vectors of these lengths along twice these angles.
double squared_distance(double length_a, double angle_a_rad, double length_b, double angle_b_rad) {
  return length_a * length_a + length_b * length_b -
         2.0 * length_a * length_b * std::cos(2.0 * (angle_a_rad - angle_b_rad));
}

double blurred(double semi_axis_px) {
  return std::sqrt(semi_axis_px * semi_axis_px + kBlur_px2);
}

// Squared difference of the two ellipses' elongations: both how long they are and which way.
double shape_difference_px2(const ImageEllipse& expected, const ImageEllipse& seen) {
  return squared_distance(blurred(expected.semi_major_px) - blurred(expected.semi_minor_px),
                          expected.angle_rad, seen.semi_major_px - seen.semi_minor_px,
                          seen.angle_rad);
}

double normal_density(double squared, double sigma) {
  const double variance = sigma * sigma;
  return std::exp(-0.5 * squared / variance) / (2.0 * std::numbers::pi * variance);
}

}  // namespace

ImageEllipse ellipse_of(const image::Region& region) {
  return {region.semi_major_px, region.semi_minor_px, region.angle_rad};
}

bool may_be(const ImageEllipse& expected, const ImageEllipse& seen) {
  const double odd_px = kOdd * expected.semi_major_px + kOddRim_px;
  return within(seen.semi_major_px, expected.semi_major_px, kShrinkMajor) &&
         within(seen.semi_minor_px, expected.semi_minor_px, kShrinkMinor) &&
         shape_difference_px2(expected, seen) <= odd_px * odd_px;
}

double ellipse_log_odds(const ImageEllipse& expected, const ImageEllipse& seen) {
  const double per_major = 1.0 / seen.semi_major_px;
  const double elongation = 1.0 - seen.semi_minor_px * per_major;
  const double clutter = normal_density(elongation * elongation, kClutterSigma);
  const double plain = normal_density(shape_difference_px2(expected, seen), kSigma_px) *
                       seen.semi_major_px * seen.semi_major_px;
  const double dot = (1.0 - kOddPart) * plain + kOddPart * clutter;
  const double other = (1.0 - kLikeDotsPart) * clutter + kLikeDotsPart * dot;
  const double odds = std::log(dot / other);
  return odds >= kLeastEllipseLogOdds ? odds : kLeastEllipseLogOdds;  // so is NaN
}

}  // namespace dottrack::estimation
