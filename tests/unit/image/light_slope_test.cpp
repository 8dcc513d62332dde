// Dots under uneven light: what their fit says of its slope, and how far that moves the centre.

#include "tests/unit/image/dot_fit_fixture.h"

namespace dottrack::image::test {
namespace {

constexpr double kContrastToNoise = 50.0;
constexpr int kStrips = 12;  // of even light, that a slope is painted with
constexpr int kDots = 300;

// Of some dots; along and across the slope.
struct Findings {
  int count = 0;
  int flawed = 0;
  int explained = 0;                  // of the flawed ones
  Vector2d slope = Vector2d::Zero();  // mean, as a part of the true one
  Vector2d off = Vector2d::Zero();    // mean error of the centre
  Vector2d moved = Vector2d::Zero();  // the same with the true slope's shift taken out
  double chi2 = 0.0;                  // of the slope, mean: 2 is true
};

class LightSlopeTest : public DotFitTest {
 protected:
  // `change`: of the light over the dot's radius, as a part of the contrast.
  Picture paint(const PaintedEllipse& dot, const Vector2d& along, double change) {
    const double radius = dot.semi_major_px;
    Canvas canvas = background({});
    canvas.paint(&dot, {}, kContrast_dn * (1.0 - change));
    for (int i = 0; i < kStrips && change > 0.0; ++i) {
      const double at = radius * (2.0 * (i + 0.5) / kStrips - 1.0);
      canvas.paint(&dot, {{dot.centre + at * along, along}}, kContrast_dn * 2.0 * change / kStrips);
    }
    return canvas.expose({kContrast_dn / kContrastToNoise, 0.0}, random_);
  }

  Findings measure(double diameter_px, double change) {
    Findings all;
    for (int i = 0; i < kDots; ++i) {
      const PaintedEllipse dot = disc(diameter_px);
      const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
      const Vector2d along(std::cos(angle), std::sin(angle));
      const Picture picture = paint(dot, along, change);
      const auto region = region_at(picture, dot.centre, kContrast_dn);
      if (!region) continue;
      const ExpectedOutline expected{dot.semi_major_px, dot.semi_minor_px, 0.0};
      add(fit_dot(picture.view(), *region, &expected), dot, along, change, all);
    }
    const double n = std::max(all.count, 1);
    for (Vector2d* mean : {&all.slope, &all.off, &all.moved}) *mean /= n;
    all.chi2 /= n;
    return all;
  }

 private:
  static void add(const DotFit& fit, const PaintedEllipse& dot, const Vector2d& along,
                  double change, Findings& all) {
    ++all.count;
    all.flawed += fit.flaw != DotFlaw::none ? 1 : 0;
    all.explained += fit.light.explains ? 1 : 0;
    const Vector2d across(-along.y(), along.x());
    const auto turned = [&](const Vector2d& v) { return Vector2d(v.dot(along), v.dot(across)); };
    const Vector2d truth = change / dot.semi_major_px * along;
    const Vector2d off = fit.centre_px - dot.centre;
    all.off += turned(off);
    all.moved += turned(off - fit.light.centre_by_slope_px2 * truth);
    if (change > 0.0) all.slope += turned(fit.light.slope_per_px) / truth.norm();
    const Vector2d wrong = fit.light.slope_per_px - truth;
    all.chi2 += wrong.dot(fit.light.information_px2 * wrong);
  }
};

TEST_F(LightSlopeTest, EvenLightHasNoneAndItsInformationIsTrue) {
  for (const double diameter_px : {4.0, 5.0, 8.0, 12.0, 20.0}) {
    const Findings found = measure(diameter_px, 0.0);
    ASSERT_GE(found.count, kDots - 3);
    EXPECT_NEAR(found.chi2, 2.0, 0.35) << diameter_px;
    EXPECT_LE(found.flawed, 3) << diameter_px;
  }
}

TEST_F(LightSlopeTest, AFifthOverTheRadiusMovesTheCentreByAsMuchAsIsSaid) {
  for (const double diameter_px : {5.0, 8.0, 12.0, 20.0}) {
    const Findings found = measure(diameter_px, 0.2);
    ASSERT_GE(found.count, kDots - 3);
    EXPECT_GT(found.off.x(), 0.13) << diameter_px;
    EXPECT_LT(found.moved.norm(), 0.01) << diameter_px;
    EXPECT_NEAR(found.slope.x(), 1.0, 0.05) << diameter_px;
    EXPECT_NEAR(found.slope.y(), 0.0, 0.05) << diameter_px;
  }
}

TEST_F(LightSlopeTest, IsAFlawThatLightExplains) {
  for (const double diameter_px : {8.0, 12.0, 20.0}) {
    const Findings found = measure(diameter_px, 0.2);
    EXPECT_GE(found.flawed, kDots * 98 / 100) << diameter_px;
    EXPECT_GE(found.explained, found.flawed * 95 / 100) << diameter_px;
  }
}

TEST_F(LightSlopeTest, DoesNotExplainACoveredDot) {
  int flawed = 0;
  int explained = 0;
  for (int i = 0; i < kDots; ++i) {
    const PaintedEllipse dot = disc(real(random_, 8.0, 20.0));
    const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
    const Vector2d along(std::cos(angle), std::sin(angle));
    Canvas canvas = background({});
    canvas.paint(&dot, {}, kContrast_dn);
    const HalfPlane cover{dot.centre + dot.semi_major_px * real(random_, -0.3, 0.9) * along, along};
    canvas.paint(&dot, {cover}, -kContrast_dn);
    const Picture picture = canvas.expose({kContrast_dn / kContrastToNoise, 0.0}, random_);
    const auto region = region_at(picture, dot.centre, kContrast_dn);
    if (!region) continue;
    const ExpectedOutline expected{dot.semi_major_px, dot.semi_minor_px, 0.0};
    const DotFit fit = fit_dot(picture.view(), *region, &expected);
    flawed += fit.flaw != DotFlaw::none ? 1 : 0;
    explained += fit.light.explains ? 1 : 0;
  }
  EXPECT_GT(flawed, kDots * 9 / 10);
  EXPECT_LE(explained, flawed / 100);
}

}  // namespace
}  // namespace dottrack::image::test
