// The dot fit's accuracy, and how well it knows it.

#include <algorithm>

#include "tests/unit/image/dot_fit_fixture.h"

namespace dottrack::image::test {
namespace {

// Of a centre's coordinate, with radius, contrast and level unknown too: from the painter's
// pictures by differences, at noise 1 and contrast 1.
double cramer_rao(double diameter_px, double blur_px) {
  const auto picture = [&](double dx, double dy, double dr) {
    Canvas canvas(kSide_px, blur_px);
    const PaintedEllipse ellipse{
        {24.2 + dx, 24.3 + dy}, diameter_px / 2.0 + dr, diameter_px / 2.0 + dr, 0.0};
    canvas.paint(&ellipse, {}, 1.0);
    return canvas;
  };
  constexpr double kStep = 0.01;
  const Canvas at = picture(0.0, 0.0, 0.0);
  const Canvas right = picture(kStep, 0.0, 0.0);
  const Canvas left = picture(-kStep, 0.0, 0.0);
  const Canvas down = picture(0.0, kStep, 0.0);
  const Canvas up = picture(0.0, -kStep, 0.0);
  const Canvas larger = picture(0.0, 0.0, kStep);
  const Canvas smaller = picture(0.0, 0.0, -kStep);
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      Eigen::Matrix<double, 5, 1> by;
      by << (right.at(x, y) - left.at(x, y)) / (2.0 * kStep),
          (down.at(x, y) - up.at(x, y)) / (2.0 * kStep),
          (larger.at(x, y) - smaller.at(x, y)) / (2.0 * kStep), at.at(x, y), 1.0;
      information += by * by.transpose();
    }
  }
  return std::sqrt(information.inverse()(0, 0));
}

double cramer_rao_formula(double diameter_px, double blur_px) {
  const double edge = std::sqrt(blur_px * blur_px + 1.0 / 12.0);
  return std::sqrt(4.0 * std::sqrt(std::numbers::pi) * edge / (std::numbers::pi * diameter_px));
}

TEST(CramerRao, TheBoundOfThePaintedDotsIsTheKnownOne) {
  for (const double blur : {0.5, 0.65, 0.8}) {
    for (const double diameter : {4.0, 6.0, 8.0, 14.0, 20.0}) {
      const double ratio = cramer_rao(diameter, blur) / cramer_rao_formula(diameter, blur);
      EXPECT_GT(ratio, 0.99) << diameter;
      EXPECT_LT(ratio, diameter < 6.0 ? 1.10 : 1.04) << diameter << ' ' << blur;
    }
  }
}

// A standard deviation of n errors is known to a part in sqrt(4 n) for two axes each.
TEST_F(DotFitTest, ReachesTheBoundWithoutBias) {
  constexpr int kDots = 25;
  int settings = 0;
  double sum_ratio = 0.0;
  int flawed = 0;
  int count = 0;
  for (const double diameter : {4.0, 6.0, 8.0, 14.0, 20.0}) {
    for (const double blur : {0.5, 0.8}) {
      const double bound = cramer_rao(diameter, blur);
      for (const double ratio : {20.0, 50.0}) {
        for (const double slope : {0.0, 1.0}) {
          const Errors errors = measure({diameter, ratio, blur, slope}, kDots);
          EXPECT_GT(errors.count, 0.99 * kDots * kExposures);
          const double of_bound = errors.rms_px() * ratio / bound;
          const double bias = errors.bias_px() * ratio / bound;
          const double spread = 1.0 / std::sqrt(4.0 * errors.count);
          EXPECT_LT(of_bound, 1.05 + 3.0 * spread)
              << diameter << " px, " << ratio << ", blur " << blur << ", slope " << slope;
          EXPECT_GT(of_bound, 1.0 - 3.0 * spread) << "too good to be true";
          EXPECT_LT(bias, 0.2) << diameter << " px, " << ratio << ", blur " << blur;
          sum_ratio += of_bound;
          flawed += errors.flawed;
          count += errors.count;
          ++settings;
          RecordProperty("worst", std::to_string(of_bound));
        }
      }
    }
  }
  EXPECT_EQ(settings, 40);
  EXPECT_LT(sum_ratio / settings, 1.045);
  EXPECT_LT(flawed, 0.01 * count);
}

TEST_F(DotFitTest, ItsCovarianceIsTrue) {
  for (const double diameter : {4.0, 8.0, 20.0}) {
    for (const double per_dn : {0.0, 1.0 / 40.0}) {
      Setting setting{.diameter_px = diameter, .contrast_to_noise = 30.0, .per_dn = per_dn};
      const Errors errors = measure(setting, 80);
      EXPECT_GT(errors.count, 2300);
      EXPECT_GT(errors.nees(), diameter < 6.0 ? 1.75 : 1.85) << diameter << ' ' << per_dn;
      EXPECT_LT(errors.nees(), diameter < 6.0 ? 2.45 : 2.2) << diameter << ' ' << per_dn;
    }
  }
}

TEST_F(DotFitTest, MeasuresTheOutlineItself) {
  for (const double ratio : {1.0, 0.6, 0.35}) {
    for (int i = 0; i < 20; ++i) {
      PaintedEllipse ellipse{{24.3, 23.8}, 7.0, 7.0 * ratio, real(random_, -1.5, 1.5)};
      Canvas canvas = background({.slope_dn = 0.5});
      canvas.paint(&ellipse, {}, kContrast_dn);
      const Picture picture = canvas.expose({1.0, 0.0}, random_);
      const auto region = region_at(picture, ellipse.centre, kContrast_dn);
      ASSERT_TRUE(region);
      const ExpectedOutline expected{ellipse.semi_major_px, ellipse.semi_minor_px,
                                     ellipse.angle_rad};
      const DotFit fit = fit_dot(picture.view(), *region, &expected);
      EXPECT_EQ(fit.flaw, DotFlaw::none) << ratio << ' ' << fit.misfit;
      EXPECT_LT((fit.centre_px - ellipse.centre).norm(), 0.03);
      EXPECT_NEAR(fit.semi_major_px, ellipse.semi_major_px, 0.1);
      EXPECT_NEAR(fit.semi_minor_px, ellipse.semi_minor_px, 0.1);
      EXPECT_NEAR(fit.contrast_dn, kContrast_dn, 6.0);
      EXPECT_NEAR(fit.background_dn, kLevel_dn, 3.0);
      if (ratio < 1.0) {
        EXPECT_NEAR(std::sin(fit.angle_rad - ellipse.angle_rad), 0.0, 0.03);
      }
    }
  }
}

TEST_F(DotFitTest, DarkDotsAreTheSame) {
  const Errors errors = measure({.slope_dn = 1.0, .contrast_dn = -kContrast_dn}, 30);
  EXPECT_GT(errors.count, 890);
  EXPECT_LT(errors.rms_px() * 20.0, 1.1 * cramer_rao(8.0, 0.65));
  EXPECT_LE(errors.flawed, 9);
}

}  // namespace
}  // namespace dottrack::image::test
