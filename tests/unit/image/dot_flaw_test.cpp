// What the dot fit says of dots that are not whole.

#include <algorithm>

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
    for (int i = 0; i < 600; ++i) {
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
    EXPECT_GT(counts.biased, 200);
    EXPECT_GE(counts.recognised, 0.99 * counts.biased) << diameter << " px: " << counts.biased;
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

}  // namespace
}  // namespace dottrack::image::test
