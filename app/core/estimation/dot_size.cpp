#include "app/core/estimation/dot_size.h"

#include <algorithm>

#include "app/core/estimation/sighting_bounds.h"

namespace dottrack::estimation {
namespace {

// Shape (paper 3.3): a disc seen at 78 degrees from its normal has an axis ratio of 0.2; a filled
// ellipse fills the ellipse of its own moments, open or branched shapes do not.
constexpr double kMinAxisRatio = 0.2;
constexpr double kMinFill = 0.75;
constexpr int kMinArea_px = 3;

// How far a dot's bounding box may be from its ellipse's, and how much of that ellipse it may lack.
// Of 29,000 rendered ellipses (3 to 30 px, axis ratio 0.2 to 1, blur of 0.3 to 1.2 px, contrast 8
// to 50 times the noise, threshold at 0.3 to 0.6 of it) none is refused; the worst is 0.15 px below
// the first limit and 0.07 px below the second, 999 in 1000 are 0.25 px and 0.16 px below.
constexpr double kMaxBoxMisfit_px = 1.25;
constexpr double kMaxBoxMisfitPart = 0.05;
constexpr double kMaxLack_px = 0.6;

// A dot's core stands out more than its rim by at least this part of the contrast asked for; specks
// of noise that rise over a low threshold do not (4 in 5 of them on the real plate images).
constexpr double kCorePart = 0.5;

}  // namespace

SemiMajorRange expected_semi_major(const DiameterRange& diameter, double range_m,
                                   const geometry::AngularScale& scale) {
  return {kShrink * 0.5 * diameter.min_m / range_m * scale.min_px,
          kGrow * 0.5 * diameter.max_m / range_m * scale.max_px + kGrowRim_px};
}

RangeWindow possible_range(const DiameterRange& diameter, double semi_major_px,
                           const geometry::AngularScale& scale, const RangeWindow& limits) {
  const double near_m = kShrink * 0.5 * diameter.min_m * scale.min_px / semi_major_px;
  const double rimless_px = semi_major_px - kGrowRim_px;
  const double far_m =
      rimless_px > 0.0 ? kGrow * 0.5 * diameter.max_m * scale.max_px / rimless_px : limits.far_m;
  return {std::max(near_m, limits.near_m), std::min(far_m, limits.far_m)};
}

image::RegionGate dot_gate(const core::Camera& camera, const SemiMajorRange& size) {
  image::RegionGate gate;
  gate.semi_major_min_px = size.min_px;
  gate.semi_major_max_px = size.max_px;
  gate.min_axis_ratio = kMinAxisRatio;
  gate.min_fill = kMinFill;
  gate.min_area_px = kMinArea_px;
  gate.max_box_misfit_px = kMaxBoxMisfit_px;
  gate.max_box_misfit_part = kMaxBoxMisfitPart;
  gate.max_lack_px = kMaxLack_px;
  gate.min_core_contrast_dn = kCorePart * camera.min_contrast_dn;
  return gate;
}

}  // namespace dottrack::estimation
