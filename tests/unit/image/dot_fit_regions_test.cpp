// The dot fit on whatever identify may find, and on every SIMD target.

#include <hwy/targets.h>

#include <algorithm>
#include <cstring>

#include "tests/unit/image/dot_fit_fixture.h"

namespace dottrack::image::test {
namespace {

bool defined(const DotFit& fit, const Region& region) {
  return fit.centre_px.allFinite() && fit.covariance_px2.allFinite() &&
         fit.covariance_px2(0, 0) > 0.0 && fit.covariance_px2.determinant() > 0.0 &&
         std::isfinite(fit.semi_major_px) && std::isfinite(fit.semi_minor_px) &&
         std::isfinite(fit.misfit) && std::isfinite(fit.noise_dn) &&
         (fit.centre_px - region.centroid_px).norm() <= 0.5 * region.semi_major_px + 0.5;
}

// Whatever the region says: of noise, of images of any size, far too large or too small.
TEST_F(DotFitTest, IsDefinedForEveryRegion) {
  int fitted = 0;
  for (int i = 0; i < 3000; ++i) {
    const Picture picture = random_picture(random_, 60);
    Region region;
    region.centroid_px = {real(random_, 0.0, picture.width_px() - 1.0),
                          real(random_, 0.0, picture.height_px() - 1.0)};
    region.semi_major_px = std::exp(real(random_, -1.0, 4.0));
    region.semi_minor_px = region.semi_major_px * real(random_, 0.02, 1.0);
    region.angle_rad = real(random_, -1.57, 1.57);
    const DotFit fit = fit_dot(picture.view(), region, nullptr);
    EXPECT_TRUE(defined(fit, region)) << i;
    if (fit.flaw != DotFlaw::not_fitted) ++fitted;
  }
  EXPECT_GT(fitted, 100);
}

bool same(const DotFit& a, const DotFit& b) {
  return a.centre_px == b.centre_px && a.covariance_px2 == b.covariance_px2 &&
         a.semi_major_px == b.semi_major_px && a.semi_minor_px == b.semi_minor_px &&
         a.angle_rad == b.angle_rad && a.background_dn == b.background_dn &&
         a.contrast_dn == b.contrast_dn && a.noise_dn == b.noise_dn && a.misfit == b.misfit &&
         a.flaw == b.flaw;
}

TEST_F(DotFitTest, IsTheSameOnEveryTarget) {
  const auto targets = hwy::SupportedAndGeneratedTargets();
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Setting setting{.diameter_px = real(random_, 3.0, 24.0), .slope_dn = 0.5};
    const PaintedEllipse ellipse = disc(setting.diameter_px);
    Canvas canvas = background(setting);
    canvas.paint(&ellipse, {}, kContrast_dn);
    const Picture picture = canvas.expose(setting.noise(), random_);
    const auto region = region_at(picture, ellipse.centre, kContrast_dn);
    if (!region) continue;
    const DotFit best = fit_dot(picture.view(), *region, nullptr);
    for (const std::int64_t target : targets) {
      hwy::SetSupportedTargetsForTest(target);
      EXPECT_TRUE(same(fit_dot(picture.view(), *region, nullptr), best)) << hwy::TargetName(target);
      ++compared;
    }
    hwy::SetSupportedTargetsForTest(0);
  }
#if HWY_ARCH_X86
  ASSERT_GE(targets.size(), 2U);
#endif
  EXPECT_GT(compared, 190 * static_cast<int>(targets.size()));
}

}  // namespace
}  // namespace dottrack::image::test
