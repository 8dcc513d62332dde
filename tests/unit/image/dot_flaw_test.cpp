// What the dot fit says of dots that are not whole, and of what is no dot.

#include <hwy/targets.h>

#include <algorithm>
#include <cstring>

#include "tests/unit/image/dot_fit_fixture.h"

namespace dottrack::image::test {
namespace {

struct Counts {
  int biased = 0;      // by more than 0.1 px
  int recognised = 0;  // of these
};

void count(const DotFit& fit, const Vector2d& truth, Counts& counts) {
  if ((fit.centre_px - truth).norm() <= 0.1) return;
  ++counts.biased;
  if (fit.flaw != DotFlaw::none) ++counts.recognised;
}

// By a straight edge at any angle, brighter or darker than the background.
TEST_F(DotFitTest, RecognisesHiddenDots) {
  for (const double diameter : {6.0, 8.0, 14.0, 20.0}) {
    Counts counts;
    for (int i = 0; i < 600; ++i) {
      const Setting setting{.diameter_px = diameter, .contrast_to_noise = i % 2 == 0 ? 20.0 : 50.0};
      const PaintedEllipse ellipse = disc(diameter);
      const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
      const Vector2d normal(std::cos(angle), std::sin(angle));
      const double depth = real(random_, -0.7, 0.5) * diameter / 2.0;
      const HalfPlane seen{ellipse.centre + depth * normal, normal};
      const HalfPlane hidden{seen.through, -normal};
      Canvas canvas = background(setting);
      canvas.paint(&ellipse, {seen}, kContrast_dn);
      canvas.paint(nullptr, {hidden}, real(random_, -40.0, 30.0));
      const Picture picture = canvas.expose(setting.noise(), random_);
      const auto region = region_at(picture, ellipse.centre, kContrast_dn);
      if (!region) continue;
      const ExpectedOutline expected{diameter / 2.0, diameter / 2.0, 0.0};
      count(fit_dot(picture.view(), *region, &expected), ellipse.centre, counts);
    }
    EXPECT_GT(counts.biased, 280);
    EXPECT_GE(counts.recognised, 0.99 * counts.biased) << diameter << " px: " << counts.biased;
  }
}

// A shadow's soft edge lies across the dot and its surround.
TEST_F(DotFitTest, RecognisesHalfShadowedDots) {
  for (const double diameter : {8.0, 20.0}) {
    Counts counts;
    for (int i = 0; i < 240; ++i) {
      const Setting setting{.diameter_px = diameter, .contrast_to_noise = 50.0};
      const PaintedEllipse ellipse = disc(diameter);
      const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
      const Vector2d normal(std::cos(angle), std::sin(angle));
      const double depth = real(random_, -0.6, 0.6) * diameter / 2.0;
      const double width_px = real(random_, 0.0, 4.0);
      const double loss = real(random_, 0.2, 0.7);
      Canvas canvas = background(setting);
      canvas.paint(&ellipse, {}, kContrast_dn);
      constexpr int kSteps = 8;
      for (int k = 0; k < kSteps; ++k) {
        const double at = depth + width_px * ((k + 0.5) / kSteps - 0.5);
        const HalfPlane dark{ellipse.centre + at * normal, normal};
        canvas.paint(&ellipse, {dark}, -loss * kContrast_dn / kSteps);
        canvas.paint(nullptr, {dark}, -loss * kLevel_dn / kSteps);
      }
      const Picture picture = canvas.expose(setting.noise(), random_);
      const auto region = region_at(picture, ellipse.centre, kContrast_dn);
      if (!region) continue;
      const ExpectedOutline expected{diameter / 2.0, diameter / 2.0, 0.0};
      count(fit_dot(picture.view(), *region, &expected), ellipse.centre, counts);
    }
    EXPECT_GT(counts.biased, 80);
    EXPECT_GE(counts.recognised, (diameter < 14.0 ? 0.955 : 0.99) * counts.biased)
        << diameter << " px: " << counts.biased;
  }
}

TEST_F(DotFitTest, RecognisesBloomedDots) {
  for (const double diameter : {6.0, 8.0, 14.0, 20.0}) {
    Counts counts;
    for (int i = 0; i < 600; ++i) {
      const PaintedEllipse ellipse = disc(diameter);
      Canvas canvas = background({.diameter_px = diameter, .contrast_to_noise = 50.0});
      canvas.paint(&ellipse, {}, real(random_, 230.0, 500.0));
      canvas.bloom(280.0);
      const Picture picture = canvas.expose({1.0, 1.0 / 40.0}, random_);
      const auto region = region_at(picture, ellipse.centre, 150.0);
      if (!region) continue;
      const ExpectedOutline expected{diameter / 2.0, diameter / 2.0, 0.0};
      const DotFit fit = fit_dot(picture.view(), *region, &expected);
      count(fit, ellipse.centre, counts);
    }
    EXPECT_GT(counts.biased, 150);
    EXPECT_GE(counts.recognised, 0.99 * counts.biased) << diameter << " px: " << counts.biased;
  }
}

// A second disc of its own brightness beside it, from touching to a pixel apart.
TEST_F(DotFitTest, RecognisesMergedDots) {
  Counts counts;
  for (int i = 0; i < 600; ++i) {
    const PaintedEllipse ellipse = disc(8.0);
    const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
    PaintedEllipse other = ellipse;
    other.centre += real(random_, 5.0, 9.0) * Vector2d(std::cos(angle), std::sin(angle));
    Canvas canvas = background({});
    canvas.paint(&ellipse, {}, 80.0);
    canvas.paint(&other, {}, 80.0);
    const Picture picture = canvas.expose({2.0, 0.0}, random_);
    const auto region = region_at(picture, ellipse.centre, 80.0);
    if (!region) continue;
    const ExpectedOutline expected{4.0, 4.0, 0.0};
    count(fit_dot(picture.view(), *region, &expected), ellipse.centre, counts);
  }
  EXPECT_GT(counts.biased, 200);
  EXPECT_GE(counts.recognised, 0.99 * counts.biased);
}

TEST_F(DotFitTest, TheImagesEndIsABorder) {
  for (const double off_px : {-3.0, 0.0, 3.0}) {
    PaintedEllipse ellipse{{off_px, 24.0}, 4.0, 4.0, 0.0};
    Canvas canvas = background({});
    canvas.paint(&ellipse, {}, kContrast_dn);
    const Picture picture = canvas.expose({1.0, 0.0}, random_);
    const auto region = region_at(picture, ellipse.centre, kContrast_dn);
    ASSERT_TRUE(region) << off_px;
    const DotFit fit = fit_dot(picture.view(), *region, nullptr);
    EXPECT_NE(fit.flaw, DotFlaw::none) << off_px;
    EXPECT_GT(std::sqrt(fit.covariance_px2(0, 0)), 0.1);
  }
}

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
