#include "app/core/image/arc_tangent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dottrack::image {
namespace {

TEST(ArcTangent, AgreesWithTheCLibraryAllTheWayRound) {
  int angles = 0;
  for (int i = -100000; i <= 100000; ++i) {
    const double angle = std::numbers::pi * i / 100000.0;
    const double y = 3.0 * std::sin(angle);
    const double x = 3.0 * std::cos(angle);
    ASSERT_NEAR(arc_tangent(y, x), std::atan2(y, x), 2e-8) << angle;
    ++angles;
  }
  EXPECT_EQ(angles, 200001);
}

TEST(ArcTangent, KnowsTheAxesAndTheOrigin) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, 2.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, -2.0), kPi);
  EXPECT_EQ(arc_tangent(-0.0, -2.0), kPi);
  EXPECT_EQ(arc_tangent(2.0, 0.0), kPi / 2);
  EXPECT_EQ(arc_tangent(-2.0, 0.0), -kPi / 2);
}

}  // namespace
}  // namespace dottrack::image
