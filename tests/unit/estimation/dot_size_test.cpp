#include "app/core/estimation/dot_size.h"

#include <gtest/gtest.h>

namespace dottrack::estimation {
namespace {

constexpr DiameterRange kDots{0.08, 0.12};
constexpr geometry::AngularScale kScale{450.0, 520.0};
constexpr RangeWindow kRoom{1.0, 20.0};

TEST(DotSize, ANominalDotIsExpected) {
  for (double range_m = 2.0; range_m < 15.0; range_m += 0.5) {
    const double semi_major_px = 0.5 * 0.1 / range_m * 480.0;
    EXPECT_TRUE(expected_semi_major(kDots, range_m, kScale).contains(semi_major_px)) << range_m;
  }
}

TEST(DotSize, HalfAndThriceTheSizeAreNot) {
  const double small_px = 0.5 * 0.08 / 3.0 * 450.0;
  const double large_px = 0.5 * 0.12 / 3.0 * 520.0;
  EXPECT_FALSE(expected_semi_major(kDots, 3.0, kScale).contains(0.5 * small_px));
  EXPECT_FALSE(expected_semi_major(kDots, 3.0, kScale).contains(3.0 * large_px));
}

// Size from distance and distance from size are one gate.
TEST(DotSize, PossibleRangeIsWhereTheSizeIsExpected) {
  int inside = 0;
  int outside = 0;
  for (double semi_major_px = 0.5; semi_major_px < 30.0; semi_major_px += 0.37) {
    const RangeWindow window = possible_range(kDots, semi_major_px, kScale, kRoom);
    for (double range_m = 1.05; range_m < 20.0; range_m += 0.113) {
      const bool expected = expected_semi_major(kDots, range_m, kScale).contains(semi_major_px);
      EXPECT_EQ(window.contains(range_m), expected)
          << semi_major_px << " px at " << range_m << " m";
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

TEST(DotSize, ASizeThatNoDistanceExplainsHasNoRange) {
  EXPECT_TRUE(possible_range(kDots, 80.0, kScale, {3.0, 20.0}).empty());
  EXPECT_TRUE(possible_range(kDots, 0.5, kScale, {1.0, 10.0}).empty());
}

TEST(DotGate, AsksForACoreOnlyWhereContrastIsAskedFor) {
  core::Camera camera;
  EXPECT_EQ(dot_gate(camera, {2.0, 5.0}).min_core_contrast_dn, 0.0);
  camera.min_contrast_dn = 8;
  const image::RegionGate gate = dot_gate(camera, {2.0, 5.0});
  EXPECT_EQ(gate.min_core_contrast_dn, 4.0);
  EXPECT_EQ(gate.semi_major_min_px, 2.0);
  EXPECT_EQ(gate.semi_major_max_px, 5.0);
}

TEST(DotGate, AsksForAnEllipse) {
  const image::RegionGate gate = dot_gate({}, {2.0, 5.0});
  EXPECT_LT(gate.max_box_misfit_px, 2.0);
  EXPECT_LT(gate.max_lack_px, 1.0);
  EXPECT_GT(gate.min_fill, 0.5);
}

}  // namespace
}  // namespace dottrack::estimation
