#include "app/workstation/straightness.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace dottrack::workstation {
namespace {

using Eigen::Vector3d;

// A zigzag about a level line: +-h to the sides and +-v up and down, in all four combinations.
std::vector<Vector3d> zigzag(double h, double v) {
  std::vector<Vector3d> points;
  const Vector3d along = Vector3d(3.0, 4.0, 0.0) / 5.0;
  const Vector3d side = Vector3d(-4.0, 3.0, 0.0) / 5.0;
  constexpr std::array<std::array<int, 2>, 4> kSigns = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (int i = 0; i < 400; ++i) {
    const auto& sign = kSigns[static_cast<std::size_t>(i % 4)];
    points.push_back(Vector3d(1.0, 2.0, 3.0) + 0.02 * i * along + sign[0] * h * side +
                     sign[1] * v * Vector3d::UnitZ());
  }
  return points;
}

TEST(StraightnessTest, TellsLevelFromUpright) {
  const Straightness result = straightness_of(zigzag(0.004, 0.003));
  EXPECT_EQ(result.points, 400U);
  EXPECT_NEAR(result.horizontal_rms_m, 0.004, 2e-6);
  EXPECT_NEAR(result.vertical_rms_m, 0.003, 2e-6);
  EXPECT_NEAR(result.rms_m, 0.005, 2e-6);
  EXPECT_NEAR(result.max_m, 0.005, 5e-5);
}

TEST(StraightnessTest, AStraightLineIsStraight) {
  const Straightness result = straightness_of(zigzag(0.0, 0.0));
  EXPECT_LT(result.max_m, 1e-12);
}

TEST(StraightnessTest, TwoPointsSayNothing) {
  EXPECT_EQ(straightness_of(std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}}).points, 0U);
}

TEST(StraightnessTest, RunsCountByTheirPoints) {
  const Straightness a{300, 0.001, 0.0, 0.001, 0.002};
  const Straightness b{100, 0.005, 0.0, 0.005, 0.009};
  const Straightness all = together(std::array{a, b});
  EXPECT_EQ(all.points, 400U);
  EXPECT_NEAR(all.horizontal_rms_m, std::sqrt((300 * 1e-6 + 100 * 25e-6) / 400), 1e-12);
  EXPECT_EQ(all.max_m, 0.009);
  EXPECT_EQ(together({}).points, 0U);
}

}  // namespace
}  // namespace dottrack::workstation
