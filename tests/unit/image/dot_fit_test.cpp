#include "app/core/image/dot_fit.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>

#include "app/core/image/identify.h"
#include "tests/unit/image/painted_dot.h"

namespace dottrack::image::test {
namespace {

using Eigen::Vector2d;

constexpr int kSide_px = 48;
constexpr double kLevel_dn = 60.0;
constexpr double kContrast_dn = 120.0;
constexpr int kExposures = 30;  // of each painted dot

struct Setting {
  double diameter_px = 8.0;
  double contrast_to_noise = 20.0;
  double blur_px = 0.65;
  double slope_dn = 0.0;
  double contrast_dn = kContrast_dn;
  double per_dn = 0.0;  // shot noise

  Noise noise() const {
    if (per_dn > 0.0) return {1.0, per_dn};
    return {std::abs(contrast_dn) / contrast_to_noise, 0.0};
  }
};

class DotFitTest : public testing::Test {
 protected:
  PaintedEllipse disc(double diameter_px) {
    return {{24.0 + real(random_, -0.5, 0.5), 24.0 + real(random_, -0.5, 0.5)},
            diameter_px / 2.0,
            diameter_px / 2.0,
            0.0};
  }

  Canvas background(const Setting& setting) {
    Canvas canvas(kSide_px, setting.blur_px);
    canvas.add_level(setting.contrast_dn > 0.0 ? kLevel_dn : 255.0 - kLevel_dn);
    const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
    canvas.add_slope(setting.slope_dn * Vector2d(std::cos(angle), std::sin(angle)));
    return canvas;
  }

  // The region at a place, as identify finds it.
  std::optional<Region> region_at(const Picture& picture, const Vector2d& place,
                                  double contrast_dn) {
    Band band{.min_contrast_dn = static_cast<int>(0.4 * std::abs(contrast_dn)),
              .background_px = 61};
    band.polarity = contrast_dn > 0.0 ? core::Polarity::bright : core::Polarity::dark;
    RegionGate gate;
    gate.min_area_px = 4;
    identifier_->identify(picture.view(), band, gate, *regions_);
    std::optional<Region> nearest;
    double least_px = 4.0;
    for (const Region& region : *regions_) {
      const double off_px = (region.centroid_px - place).norm();
      if (off_px >= least_px) continue;
      least_px = off_px;
      nearest = region;
    }
    return nearest;
  }

  struct Errors {
    int count = 0;
    int flawed = 0;
    Vector2d sum = Vector2d::Zero();
    double sum2 = 0.0;      // per axis
    double weighed2 = 0.0;  // normalised squared errors

    double rms_px() const { return std::sqrt(sum2 / count); }
    double bias_px() const { return sum.norm() / count; }
    double nees() const { return weighed2 / count; }
  };

  void add(const DotFit& fit, const Vector2d& truth, Errors& errors) {
    const Vector2d error = fit.centre_px - truth;
    ++errors.count;
    if (fit.flaw != DotFlaw::none) ++errors.flawed;
    errors.sum += error;
    errors.sum2 += error.squaredNorm() / 2.0;
    errors.weighed2 += error.dot(fit.covariance_px2.inverse() * error);
  }

  Errors measure(const Setting& setting, int dots) {
    Errors errors;
    for (int i = 0; i < dots; ++i) {
      const PaintedEllipse ellipse = disc(setting.diameter_px);
      Canvas canvas = background(setting);
      canvas.paint(&ellipse, {}, setting.contrast_dn);
      const ExpectedOutline expected{ellipse.semi_major_px, ellipse.semi_minor_px, 0.0};
      for (int k = 0; k < kExposures; ++k) {
        const Picture picture = canvas.expose(setting.noise(), random_);
        const auto region = region_at(picture, ellipse.centre, setting.contrast_dn);
        if (!region) continue;
        add(fit_dot(picture.view(), *region, &expected), ellipse.centre, errors);
      }
    }
    return errors;
  }

  Random random_{17};
  std::unique_ptr<Identifier> identifier_ = std::make_unique<Identifier>();
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

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
