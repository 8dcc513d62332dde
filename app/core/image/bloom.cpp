#include "app/core/image/bloom.h"

#include <algorithm>
#include <cmath>

namespace dottrack::image {
namespace {

constexpr int kSaturated_dn = 255;
constexpr int kFewestSaturated_px = 4;
// Grown by so much, or by half of it with a sag: a dot half a pixel off is blurred as much.
constexpr double kGrowth_px = 0.5;
constexpr double kGrowthPart = 0.08;  // of half the region's height, whose model is never exact
constexpr double kSag_px = 0.15;

// The middles of the saturated pixels of columns, summed.
struct Middles {
  double sum_px = 0.0;
  int columns = 0;

  double mean_px() const { return sum_px / columns; }
};

void add_column(const ImageView& image, const Region& region, int x, Middles& middles) {
  int n = 0;
  int sum = 0;
  for (int y = region.y_min; y <= region.y_max; ++y) {
    if (image.at(x, y) < kSaturated_dn) continue;
    ++n;
    sum += y;
  }
  if (n == 0) return;
  middles.sum_px += static_cast<double>(sum) / n;
  ++middles.columns;
}

// The middle half of the columns against the quarters on both sides of it. Columns lie in pairs
// about the middle, so that a slope of the middles, a tilted ellipse's, cancels out.
double sag_of(const ImageView& image, const Region& region) {
  Middles inner;
  Middles outer;
  const int quarter = region.width_px() / 4;
  for (int i = 0; i < quarter; ++i) {
    Middles pair;
    add_column(image, region, region.x_min + i, pair);
    add_column(image, region, region.x_max - i, pair);
    if (pair.columns < 2) continue;
    outer.sum_px += pair.sum_px;
    outer.columns += 2;
  }
  for (int x = region.x_min + quarter; x <= region.x_max - quarter; ++x) {
    add_column(image, region, x, inner);
  }
  return inner.columns == 0 || outer.columns == 0 ? 0.0 : inner.mean_px() - outer.mean_px();
}

}  // namespace

DotExtent extent_of(double semi_major_px, double semi_minor_px, double angle_rad) {
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  const double major2 = semi_major_px * semi_major_px;
  const double minor2 = semi_minor_px * semi_minor_px;
  return {std::sqrt(cosine * cosine * major2 + sine * sine * minor2),
          std::sqrt(sine * sine * major2 + cosine * cosine * minor2)};
}

BloomEvidence bloom_evidence(const ImageView& image, const Region& region,
                             const DotExtent& expected) {
  BloomEvidence evidence;
  evidence.saturated_px = region.saturated_px;
  if (region.saturated_px < kFewestSaturated_px) return evidence;
  const DotExtent seen = extent_of(region.semi_major_px, region.semi_minor_px, region.angle_rad);
  evidence.growth_px = seen.half_height_px - expected.half_height_px -
                       std::max(0.0, seen.half_width_px - expected.half_width_px);
  evidence.growth_px -= kGrowthPart * seen.half_height_px;
  evidence.sag_px = sag_of(image, region);
  return evidence;
}

bool BloomEvidence::bloomed() const {
  if (saturated_px < kFewestSaturated_px) return false;
  return growth_px > kGrowth_px || (growth_px > 0.5 * kGrowth_px && sag_px > kSag_px);
}

}  // namespace dottrack::image
