// Shapes whose size, form and place are known.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"
#include "tests/unit/image/plain_identify.h"

namespace dottrack::image::test {
namespace {

constexpr double kPi = std::numbers::pi;

class IdentifyShapes : public testing::Test {
 protected:
  IdentifyCounts identify(const Picture& picture, const Band& band, const RegionGate& gate = {}) {
    return identifier_.identify(picture.view(), band, gate, *regions_);
  }
  const Region& only_region() {
    EXPECT_EQ(regions_->size(), 1U);
    return regions_->front();
  }

  Random random_{77};
  Identifier identifier_;
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

TEST_F(IdentifyShapes, EllipsesHaveTheirAxesAndAngles) {
  int ellipses = 0;
  for (int i = 0; i < 500; ++i) {
    const double a = real(random_, 6.0, 30.0);
    const double b = a * real(random_, 0.4, 0.9);
    const double angle = real(random_, -1.5, 1.5);
    const double x = 60.0 + real(random_, -0.5, 0.5);
    const double y = 50.0 + real(random_, -0.5, 0.5);
    Picture picture(120, 100);
    add_ellipse(picture, x, y, a, b, angle, 200);
    ASSERT_EQ(identify(picture, {.intensity_min_dn = 128}).accepted, 1U);
    const Region& region = only_region();
    // The edge is off by at most a pixel's part everywhere, more at one end than at the other.
    EXPECT_NEAR(region.semi_major_px, a, 0.3);
    EXPECT_NEAR(region.semi_minor_px, b, 0.3);
    EXPECT_NEAR(region.centroid_px.x(), x, 0.2);
    EXPECT_NEAR(region.centroid_px.y(), y, 0.2);
    EXPECT_NEAR(std::sin(region.angle_rad - angle), 0.0, 0.4 / (a - b));
    EXPECT_GT(region.angle_rad, -kPi / 2.0);
    EXPECT_LE(region.angle_rad, kPi / 2.0);
    EXPECT_NEAR(region.area_px / (kPi * a * b), 1.0, 0.08);
    EXPECT_FALSE(region.touches_border);
    ++ellipses;
  }
  EXPECT_EQ(ellipses, 500);
}

TEST_F(IdentifyShapes, FillTellsEllipsesFromOtherShapes) {
  const RegionGate gate{.min_fill = 0.97};
  const Band band{.intensity_min_dn = 128};
  Picture disc(60, 60);
  add_ellipse(disc, 30.0, 30.0, 20.0, 20.0, 0.0, 255);
  EXPECT_EQ(identify(disc, band, gate).accepted, 1U);

  Picture square(60, 60);  // fill 3 / pi
  for (int y = 10; y < 50; ++y) {
    for (int x = 10; x < 50; ++x) square.at(x, y) = 255;
  }
  EXPECT_EQ(identify(square, band, gate).rejected_shape, 1U);
  EXPECT_EQ(identify(square, band, {.min_fill = 0.95}).accepted, 1U);

  Picture ring = disc;
  add_ellipse(ring, 30.0, 30.0, 14.0, 14.0, 0.0, 0);
  EXPECT_EQ(identify(ring, band, {.min_fill = 0.5}).rejected_shape, 1U);
}

TEST_F(IdentifyShapes, AxisRatioAndSizeGates) {
  Picture picture(80, 60);
  add_ellipse(picture, 40.0, 30.0, 24.0, 6.0, 0.4, 255);  // ratio 0.25
  const Band band{.intensity_min_dn = 128};
  EXPECT_EQ(identify(picture, band, {.min_axis_ratio = 0.2}).accepted, 1U);
  EXPECT_EQ(identify(picture, band, {.min_axis_ratio = 0.3}).rejected_shape, 1U);
  EXPECT_EQ(identify(picture, band, {.semi_major_max_px = 23.0}).rejected_size, 1U);
  EXPECT_EQ(identify(picture, band, {.semi_major_min_px = 25.0}).rejected_size, 1U);
  EXPECT_EQ(
      identify(picture, band, {.semi_major_min_px = 23.0, .semi_major_max_px = 25.0}).accepted, 1U);
  EXPECT_EQ(identify(picture, band, {.min_area_px = 1000}).rejected_size, 1U);
}

TEST_F(IdentifyShapes, ASpiralIsOneRegion) {
  int spirals = 0;
  for (const int size : {16, 63, 64, 65, 200, 501}) {
    Picture picture(size, size - 1);
    add_spiral(picture, 255);
    const IdentifyCounts counts = identify(picture, {.intensity_min_dn = 128});
    int comparisons = 0;
    const Band band{.intensity_min_dn = 128};
    expect_equal(plain_identify(picture, whole(picture), band, {}), counts, *regions_, comparisons);
    EXPECT_EQ(counts.components, 1U);
    EXPECT_GE(comparisons, 1);
    ++spirals;
  }
  EXPECT_EQ(spirals, 6);
}

TEST_F(IdentifyShapes, TheTeethOfACombMeetInItsLastRow) {
  Picture picture(999, 40);
  for (int x = 0; x < 999; x += 2) {
    for (int y = 0; y < 39; ++y) picture.at(x, y) = 255;
  }
  for (int x = 0; x < 999; ++x) picture.at(x, 39) = 255;
  const IdentifyCounts counts = identify(picture, {.intensity_min_dn = 128});
  EXPECT_EQ(counts.components, 1U);
  EXPECT_EQ(only_region().area_px, 500 * 39 + 999);
}

TEST_F(IdentifyShapes, DiagonalNeighboursAreNotConnected) {
  Picture picture(10, 10);
  for (const auto& [x, y] : {std::pair{2, 2}, {3, 2}, {4, 3}, {5, 3}}) picture.at(x, y) = 255;
  EXPECT_EQ(identify(picture, {.intensity_min_dn = 128}).components, 2U);
  ASSERT_EQ(regions_->size(), 2U);
  EXPECT_EQ((*regions_)[0].x_min, 2);
  EXPECT_EQ((*regions_)[1].x_min, 4);
}

TEST_F(IdentifyShapes, EachSideOfTheBorderIsTold) {
  const Band band{.intensity_min_dn = 128};
  int placed = 0;
  for (const int x : {0, 1, 60, 127, 128}) {
    for (const int y : {0, 1, 20, 37, 38}) {
      Picture picture(130, 40);
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) picture.at(x + i, y + j) = 255;
      }
      ASSERT_EQ(identify(picture, band).accepted, 1U);
      const bool border = x == 0 || y == 0 || x == 128 || y == 38;
      EXPECT_EQ(only_region().touches_border, border) << x << ' ' << y;
      ++placed;
    }
  }
  EXPECT_EQ(placed, 25);
}

TEST_F(IdentifyShapes, AWindowCutsARegionAndSaysSo) {
  Picture picture(200, 100);
  add_ellipse(picture, 100.0, 50.0, 20.0, 20.0, 0.0, 255);
  const Band band{.intensity_min_dn = 128};
  identifier_.identify(picture.view(), {70, 20, 130, 80}, band, {}, *regions_);
  EXPECT_FALSE(only_region().touches_border);
  identifier_.identify(picture.view(), {70, 20, 110, 80}, band, {}, *regions_);
  EXPECT_TRUE(only_region().touches_border);
  EXPECT_EQ(only_region().x_max, 110);
}

TEST_F(IdentifyShapes, DotsOfOnePixelWidth) {
  const Band band{.intensity_min_dn = 128};
  Picture column(1, 9);
  column.at(0, 3) = column.at(0, 4) = column.at(0, 5) = 200;
  ASSERT_EQ(identify(column, band).accepted, 1U);
  EXPECT_NEAR(only_region().centroid_px.y(), 4.0, 1e-12);
  EXPECT_NEAR(only_region().angle_rad, kPi / 2.0, 2e-8);
  EXPECT_NEAR(only_region().semi_major_px, 3.0 / std::sqrt(3.0), 1e-12);  // 2 sqrt(2/3 + 1/12)
  EXPECT_NEAR(only_region().semi_minor_px, 1.0 / std::sqrt(3.0), 1e-12);  // 2 sqrt(1/12)
}

TEST_F(IdentifyShapes, ADarkDotIsABrightOneInTheNegative) {
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const Picture picture = random_picture(random_, 120);
    Picture negative = picture;
    for (int y = 0; y < picture.height_px(); ++y) {
      for (int x = 0; x < picture.width_px(); ++x) {
        negative.at(x, y) = static_cast<std::uint8_t>(255 - picture.at(x, y));
      }
    }
    const int contrast = i % 2 == 0 ? 0 : 25;
    identify(picture, {.intensity_min_dn = 100, .min_contrast_dn = contrast});
    const Regions bright = *regions_;
    identify(
        negative,
        {.intensity_max_dn = 155, .min_contrast_dn = contrast, .polarity = core::Polarity::dark});
    ASSERT_EQ(bright.size(), regions_->size());
    for (std::size_t k = 0; k < bright.size(); ++k) {
      EXPECT_EQ(bright[k].centroid_px, (*regions_)[k].centroid_px);
      EXPECT_EQ(bright[k].area_px, (*regions_)[k].area_px);
      EXPECT_NEAR(bright[k].core_contrast_dn, (*regions_)[k].core_contrast_dn, 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

// Uneven light: a slope of 1 DN a pixel moves the centroid of neither the weights nor the region,
// since each pixel is weighed by its own background.
TEST_F(IdentifyShapes, ASlopingBackgroundDoesNotMoveACentroid) {
  int dots = 0;
  for (int i = 0; i < 50; ++i) {
    const double x = 60.0 + real(random_, -0.5, 0.5);
    const double y = 40.0 + real(random_, -0.5, 0.5);
    Picture picture(120, 80);
    for (int py = 0; py < 80; ++py) {
      for (int px = 0; px < 120; ++px) {
        const double edge = 3.5 - std::hypot(px - x, py - y);
        const double dot = 80.0 / (1.0 + std::exp(-2.0 * edge));
        picture.at(px, py) = static_cast<std::uint8_t>(std::lround(20.0 + px + dot));
      }
    }
    identify(picture, {.min_contrast_dn = 10}, {.min_area_px = 10});
    EXPECT_NEAR(only_region().centroid_px.x(), x, 0.03);
    EXPECT_NEAR(only_region().centroid_px.y(), y, 0.03);
    ++dots;
  }
  EXPECT_EQ(dots, 50);
}

}  // namespace
}  // namespace dottrack::image::test
