// Dots on plates: what lies beyond the plate's edge is not what the dot lies on.

#include <algorithm>
#include <vector>

#include "app/core/image/ring_level.h"
#include "tests/unit/image/dot_fit_fixture.h"

namespace dottrack::image::test {
namespace {

constexpr double kGround_dn = 50.0;  // above the plate
constexpr double kNoise_dn = 2.0;

// Both edges of a corner are `gap` away from the outline.
struct Plate {
  double radius_px = 4.0;
  double gap_px = 3.0;
};

class PlateTest : public DotFitTest {
 protected:
  Picture on_plate(const Plate& plate, const PaintedEllipse& dot) {
    Canvas canvas(kSide_px, 0.65);
    canvas.add_level(20.0);
    canvas.paint(&dot, {}, kContrast_dn);
    const double angle = real(random_, 0.0, 2.0 * std::numbers::pi);
    const Vector2d along(std::cos(angle), std::sin(angle));
    const Vector2d across(-along.y(), along.x());
    const double far_px = plate.radius_px + plate.gap_px;
    const HalfPlane beyond{dot.centre + far_px * along, along};
    const HalfPlane before{dot.centre + far_px * along, -along};
    canvas.paint(nullptr, {beyond}, kGround_dn);
    canvas.paint(nullptr, {before, {dot.centre + far_px * across, across}}, kGround_dn);
    return canvas.expose({kNoise_dn, 0.0}, random_);
  }

  Errors measure_on(const Plate& plate, int dots) {
    Errors errors;
    const ExpectedOutline expected{plate.radius_px, plate.radius_px, 0.0};
    for (int i = 0; i < dots; ++i) {
      const PaintedEllipse dot = disc(2.0 * plate.radius_px);
      const Picture picture = on_plate(plate, dot);
      const auto region = region_at(picture, dot.centre, 1.5 * kContrast_dn);
      if (region) add(fit_dot(picture.view(), *region, &expected), dot.centre, errors);
    }
    return errors;
  }
};

double bound_px(double radius_px) {
  const double edge = std::sqrt(0.65 * 0.65 + 1.0 / 12.0);
  return kNoise_dn / kContrast_dn *
         std::sqrt(4.0 * std::sqrt(std::numbers::pi) * edge / (2.0 * std::numbers::pi * radius_px));
}

// Without leaving the ground out these are 4 to 27 times the bound.
TEST_F(PlateTest, AnEdgeInTheRingCostsLittle) {
  constexpr int kDots = 300;
  for (const double gap_px : {3.5, 5.0, 8.0}) {
    for (const double radius_px : {3.0, 4.0, 8.0}) {
      const Errors errors = measure_on({radius_px, gap_px}, kDots);
      EXPECT_EQ(errors.count, kDots);
      EXPECT_LE(errors.flawed, kDots / 50) << radius_px << ' ' << gap_px;
      EXPECT_LT(errors.rms_px(), 1.6 * bound_px(radius_px)) << radius_px << ' ' << gap_px;
      EXPECT_LT(errors.nees(), 4.0) << radius_px << ' ' << gap_px;
      EXPECT_GT(errors.nees(), 1.6) << radius_px << ' ' << gap_px;
    }
  }
}

// A box's top with its side below, in shadow, and bright ground behind it. With as much allowed
// below the plate as above it the side was taken for sloping light: off by 0.026 px.
TEST_F(PlateTest, ABoxesDarkSideIsNotSlopingLight) {
  constexpr int kDots = 300;
  constexpr double kRadius_px = 2.5;
  for (const double gap_px : {4.0, 5.0}) {
    Vector2d sum = Vector2d::Zero();
    int count = 0;
    for (int i = 0; i < kDots; ++i) {
      PaintedEllipse dot = disc(2.0 * kRadius_px);
      dot.semi_major_px *= 2.2;
      dot.angle_rad = 0.0;
      const Vector2d down(0.0, 1.0);
      const double far_px = kRadius_px + gap_px;
      Canvas canvas(kSide_px, 0.65);
      canvas.add_level(20.0);
      canvas.paint(&dot, {}, 180.0);
      canvas.paint(nullptr, {{dot.centre - far_px * down, -down}}, 60.0);
      canvas.paint(nullptr, {{dot.centre + far_px * down, down}}, -15.0);
      const Picture picture = canvas.expose({1.0, 0.0}, random_);
      const auto region = region_at(picture, dot.centre, 90.0);
      if (!region) continue;
      sum += fit_dot(picture.view(), *region, nullptr).centre_px - dot.centre;
      ++count;
    }
    ASSERT_GE(count, kDots - 3);
    EXPECT_LT((sum / count).norm(), 0.005) << gap_px;
  }
}

TEST_F(PlateTest, AnEdgeNextToTheDotCostsMore) {
  constexpr int kDots = 300;
  for (const double radius_px : {3.0, 4.0, 8.0}) {
    const Errors errors = measure_on({radius_px, 2.5}, kDots);
    EXPECT_EQ(errors.count, kDots);
    EXPECT_LT(errors.rms_px(), 2.5 * bound_px(radius_px)) << radius_px;
    EXPECT_LT(errors.nees(), 5.0) << radius_px;
  }
}

class RingLevelTest : public testing::Test {
 protected:
  static constexpr int kSide = 21;

  RingLevelTest() : pixels_(static_cast<std::size_t>(kSide) * kPatchColumns_px) {
    rows_.count = kSide;
    rows_.outer.before.fill(-1);
    rows_.outer.after.fill(kSide);
    rows_.inner.before.fill(6);
    rows_.inner.after.fill(7);
    for (std::size_t y = 7; y < 14; ++y) rows_.inner.after[y] = 14;
  }

  ImageView view() const { return {pixels_.data(), kSide, kSide, kPatchColumns_px}; }
  std::uint8_t& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y * kPatchColumns_px + x)];
  }
  void fill(int first_row, int end_row, double mean_dn, double sigma_dn) {
    for (int y = first_row; y < end_row; ++y) {
      for (int x = 0; x < kSide; ++x) {
        at(x, y) = static_cast<std::uint8_t>(std::lround(mean_dn + normal(random_, sigma_dn)));
      }
    }
  }
  static double normal(Random& random, double sigma) {
    double sum = -6.0;  // of twelve: nearly normal, and the same with every library
    for (int i = 0; i < 12; ++i) sum += real(random, 0.0, 1.0);
    return sigma * sum;
  }

  Random random_{3};
  std::vector<std::uint8_t> pixels_;
  PatchRows rows_;
};

TEST_F(RingLevelTest, IsThatOfMostPixels) {
  fill(0, 12, 40.0, 3.0);
  for (int y = 12; y < kSide; ++y) fill(y, y + 1, 60.0 + 15.0 * (y - 12), 3.0);
  RingLevel level;
  ASSERT_TRUE(find_level(view(), rows_, level));
  EXPECT_NEAR(level.middle_dn, 40.0, 2.0);
  EXPECT_GT(level.sigma_dn, 2.0);
  EXPECT_LT(level.sigma_dn, 6.0);
}

TEST_F(RingLevelTest, DoesNotLookAtTheDot) {
  fill(0, kSide, 40.0, 2.0);
  for (int y = 7; y < 14; ++y) {
    for (int x = 7; x < 14; ++x) at(x, y) = 200;
  }
  RingLevel without;
  ASSERT_TRUE(find_level(view(), rows_, without));
  for (int y = 7; y < 14; ++y) {
    for (int x = 7; x < 14; ++x) at(x, y) = 40;
  }
  RingLevel with;
  ASSERT_TRUE(find_level(view(), rows_, with));
  EXPECT_EQ(with.middle_dn, without.middle_dn);
  EXPECT_EQ(with.sigma_dn, without.sigma_dn);
}

TEST_F(RingLevelTest, AFewPixelsTellNothing) {
  rows_.count = 1;
  rows_.outer.after[0] = 19;
  RingLevel level;
  EXPECT_FALSE(find_level(view(), rows_, level));
  rows_.outer.after[0] = 20;
  EXPECT_TRUE(find_level(view(), rows_, level));
}

}  // namespace
}  // namespace dottrack::image::test
