#include "app/workstation/clip_line.h"

#include <gtest/gtest.h>

#include <limits>

namespace dottrack::workstation {
namespace {

using Eigen::Vector2d;

const Vector2d kMin(0, 0);
const Vector2d kMax(10, 6);

TEST(ClipLine, LeavesALineInsideAsItIs) {
  Vector2d a(1, 1);
  Vector2d b(9, 5);
  ASSERT_TRUE(clip_line(kMin, kMax, a, b));
  EXPECT_EQ(a, Vector2d(1, 1));
  EXPECT_EQ(b, Vector2d(9, 5));
}

TEST(ClipLine, CutsALineThatCrosses) {
  Vector2d a(-5, 3);
  Vector2d b(15, 3);
  ASSERT_TRUE(clip_line(kMin, kMax, a, b));
  EXPECT_EQ(a, Vector2d(0, 3));
  EXPECT_EQ(b, Vector2d(10, 3));
}

TEST(ClipLine, RefusesALineOutside) {
  for (const auto& [from, to] : {std::pair(Vector2d(-1, -1), Vector2d(11, -1)),
                                 {Vector2d(-5, 5), Vector2d(2, 20)},
                                 {Vector2d(-1, 3), Vector2d(-1, 4)}}) {
    Vector2d a = from;
    Vector2d b = to;
    EXPECT_FALSE(clip_line(kMin, kMax, a, b)) << from.transpose();
  }
}

TEST(ClipLine, RefusesWhatIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    Vector2d a(1, 1);
    Vector2d b(bad, 2);
    EXPECT_FALSE(clip_line(kMin, kMax, a, b));
    EXPECT_FALSE(clip_line(kMin, kMax, b, a));
  }
}

TEST(ClipLine, CutsALineFromVeryFarAway) {
  Vector2d a(-1e12, 3);
  Vector2d b(5, 3);
  ASSERT_TRUE(clip_line(kMin, kMax, a, b));
  EXPECT_NEAR(a.x(), 0.0, 1e-3);
}

TEST(ClipLine, KeepsAPointInside) {
  Vector2d a(2, 2);
  Vector2d b(2, 2);
  EXPECT_TRUE(clip_line(kMin, kMax, a, b));
}

}  // namespace
}  // namespace dottrack::workstation
