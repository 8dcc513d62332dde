#include "app/core/estimation/dot_ellipse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "app/core/image/identify.h"

namespace dottrack::estimation {
namespace {

using geometry::ImageEllipse;

constexpr double kPi = std::numbers::pi;

// What threshold and blur make of it.
ImageEllipse grown(const ImageEllipse& e, double major_px, double minor_px, double turn_rad = 0.0) {
  return {e.semi_major_px + major_px, e.semi_minor_px + minor_px, e.angle_rad + turn_rad};
}

// The ellipses that dots of 10 cm show in a hall: flat by 0.3 to 1.
std::vector<ImageEllipse> dots() {
  std::vector<ImageEllipse> ellipses;
  for (const double major : {2.2, 3.0, 4.5, 8.0}) {
    for (const double ratio : {0.3, 0.5, 0.7, 1.0}) {
      for (const double angle : {-1.2, 0.0, 0.7, kPi / 2}) {
        ellipses.push_back({major, ratio * major, angle});
      }
    }
  }
  return ellipses;
}

TEST(DotEllipse, IsTheRegionsOwn) {
  image::Region region;
  region.semi_major_px = 5.0;
  region.semi_minor_px = 3.0;
  region.angle_rad = 0.5;
  const ImageEllipse ellipse = ellipse_of(region);
  EXPECT_EQ(ellipse.semi_major_px, 5.0);
  EXPECT_EQ(ellipse.semi_minor_px, 3.0);
  EXPECT_EQ(ellipse.angle_rad, 0.5);
}

TEST(DotEllipse, ADotMayBeItselfHoweverItIsBlurred) {
  for (const ImageEllipse& dot : dots()) {
    EXPECT_TRUE(may_be(dot, dot));
    EXPECT_TRUE(may_be(dot, grown(dot, 0.3, 0.5, 0.15)));
    EXPECT_TRUE(may_be(dot, grown(dot, 0.6, 0.6, -0.15)));
    EXPECT_TRUE(
        may_be(dot, grown(dot, 0.45 * dot.semi_major_px + 1.0, 0.45 * dot.semi_minor_px + 1.0)));
    EXPECT_TRUE(may_be(dot, grown(dot, -0.2 * dot.semi_major_px, 0.0)) ||
                dot.semi_minor_px > 0.8 * dot.semi_major_px);
  }
}

TEST(DotEllipse, MayNotBeOfAnotherSize) {
  for (const ImageEllipse& dot : dots()) {
    EXPECT_FALSE(may_be(dot, {2.0 * dot.semi_major_px + 0.6, 2.0 * dot.semi_minor_px, 0.0}));
    EXPECT_FALSE(may_be(dot, {0.5 * dot.semi_major_px, 0.5 * dot.semi_minor_px, dot.angle_rad}));
  }
}

TEST(DotEllipse, AFlatDotIsNeitherRoundNorTurned) {
  const ImageEllipse flat{8.0, 2.4, 0.4};
  EXPECT_FALSE(may_be(flat, {8.0, 8.0, 0.4}));
  EXPECT_FALSE(may_be(flat, {8.3, 2.9, 0.4 + kPi / 2}));
  EXPECT_FALSE(may_be(flat, {8.3, 2.9, 0.4 - kPi / 4}));
  EXPECT_TRUE(may_be(flat, {8.3, 2.9, 0.4 + kPi}));  // the same axis
  const ImageEllipse round{8.0, 8.0, 0.4};
  EXPECT_FALSE(may_be(round, {8.3, 2.9, 0.4}));
  EXPECT_TRUE(may_be(round, {8.3, 7.8, -1.0}));  // a round one has no angle
}

TEST(DotEllipse, WhatLooksLikeTheDotSpeaksForItAndWhatDoesNotAgainst) {
  for (const ImageEllipse& dot : dots()) {
    EXPECT_GT(ellipse_log_odds(dot, grown(dot, 0.3, 0.4)), 0.6);
  }
  const ImageEllipse flat{4.0, 1.6, 0.4};
  EXPECT_LT(ellipse_log_odds(flat, grown(flat, 0.4, 0.4, kPi / 2)), -2.0);
  EXPECT_LT(ellipse_log_odds(flat, {4.4, 4.2, 0.4}), -2.0);
  EXPECT_LT(ellipse_log_odds({4.0, 4.0, 0.0}, {4.4, 2.0, 0.4}), -2.0);
}

TEST(DotEllipse, OneViewIsWorthOnlySoMuch) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double least = 0.0;
  double most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const ImageEllipse dot{1.0 + 20.0 * part(random), part(random), kPi * part(random)};
    const double major = 1.0 + 20.0 * part(random);
    const double odds = ellipse_log_odds(dot, {major, major * part(random), kPi * part(random)});
    ASSERT_TRUE(std::isfinite(odds));
    least = std::min(least, odds);
    most = std::max(most, odds);
  }
  EXPECT_GE(least, kLeastEllipseLogOdds);
  EXPECT_LT(least, -3.0);
  EXPECT_LE(most, std::log(5.0));
  EXPECT_GT(most, 1.2);
  EXPECT_EQ(ellipse_log_odds({4.0, 2.0, 0.0}, {0.0, 0.0, 0.0}), kLeastEllipseLogOdds);
}

// A disc seen at an angle: its edge is a Gaussian step, averaged over 4 x 4 samples a pixel.
class PaintedDisc {
 public:
  static constexpr int kSize = 48;

  ImageEllipse paint(const ImageEllipse& disc, std::mt19937& random) {
    std::uniform_real_distribution<double> part(-0.5, 0.5);
    std::normal_distribution<double> noise(0.0, 3.0);
    const double cx = 24.0 + part(random);
    const double cy = 24.0 + part(random);
    pixels_.clear();
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        double sum = 0.0;
        for (int i = 0; i < 16; ++i) {
          sum += inside(disc, x - cx + (i % 4 - 1.5) / 4.0, y - cy + (i / 4 - 1.5) / 4.0) / 16.0;
        }
        pixels_.push_back(
            static_cast<std::uint8_t>(std::clamp(50.0 + 90.0 * sum + noise(random), 0.0, 255.0)));
      }
    }
    return measure();
  }

 private:
  static double inside(const ImageEllipse& disc, double x, double y) {
    const double along = std::cos(disc.angle_rad) * x + std::sin(disc.angle_rad) * y;
    const double across = std::cos(disc.angle_rad) * y - std::sin(disc.angle_rad) * x;
    const double a = along / (disc.semi_major_px * disc.semi_major_px);
    const double b = across / (disc.semi_minor_px * disc.semi_minor_px);
    const double form = along * a + across * b;
    const double slope = 2.0 * std::sqrt(a * a + b * b) + 1e-9;
    return 0.5 * std::erfc((form - 1.0) / slope / (0.6 * std::numbers::sqrt2));  // 0.6 px of blur
  }

  ImageEllipse measure() {
    image::Band band;
    band.min_contrast_dn = 25;
    image::RegionGate gate;
    gate.min_area_px = 4;
    identifier_.identify({pixels_.data(), kSize, kSize, kSize}, band, gate, regions_);
    if (regions_.size() != 1) return {};
    return ellipse_of(regions_[0]);
  }

  std::vector<std::uint8_t> pixels_;
  image::Identifier identifier_;
  image::Regions regions_;
};

// Were the densities those of the dots, the mean of exp(-log odds) over dots would be 1, or less as
// a part of clutter is never seen among dots; the same of exp(log odds) over clutter. More than
// that would be to promise what the pictures do not hold.
TEST(DotEllipse, PromisesNoMoreThanPaintedDotsAndClutterHold) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::normal_distribution<double> deviate(0.0, 0.39);
  PaintedDisc painted;
  double against = 0.0;
  double for_clutter = 0.0;
  double mean = 0.0;
  int n = 0;
  for (int i = 0; i < 400; ++i) {
    const double major = 2.2 + 4.0 * part(random);
    const ImageEllipse dot{major, major * (0.33 + 0.6 * part(random)), kPi * (part(random) - 0.5)};
    const ImageEllipse seen = painted.paint(dot, random);
    if (seen.semi_major_px == 0.0) continue;
    ++n;
    EXPECT_TRUE(may_be(dot, seen));
    const double odds = ellipse_log_odds(dot, seen);
    mean += odds;
    against += std::exp(-odds);
    const double x = deviate(random);
    const double y = deviate(random);
    const double ratio = 1.0 - std::min(std::hypot(x, y), 0.8);
    const double clutter_major = seen.semi_major_px;
    for_clutter += std::exp(
        ellipse_log_odds(dot, {clutter_major, ratio * clutter_major, 0.5 * std::atan2(y, x)}));
  }
  ASSERT_GE(n, 380);
  EXPECT_LT(against / n, 1.0);
  EXPECT_LT(for_clutter / n, 1.2);
  EXPECT_GT(mean / n, 1.0);
}

}  // namespace
}  // namespace dottrack::estimation
