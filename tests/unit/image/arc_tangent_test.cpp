#include "app/core/image/arc_tangent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace dottrack::image {
namespace {

double arc_tangent(double y, double x) {
  double angle = 0.0;
  arc_tangents({&y, 1}, {&x, 1}, {&angle, 1});
  return angle;
}

TEST(ArcTangent, AgreesWithTheCLibraryAllTheWayRound) {
  std::vector<double> y;
  std::vector<double> x;
  for (int i = -100000; i <= 100000; ++i) {
    const double angle = std::numbers::pi * i / 100000.0;
    y.push_back(3.0 * std::sin(angle));
    x.push_back(3.0 * std::cos(angle));
  }
  std::vector<double> angle(x.size());
  arc_tangents(y, x, angle);
  int angles = 0;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    ASSERT_NEAR(angle[i], std::atan2(y[i], x[i]), 2e-8) << i;
    ASSERT_EQ(angle[i], arc_tangent(y[i], x[i])) << i;  // wherever it stands in the list
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
