#include "app/core/geometry/crossover.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace dottrack::geometry {
namespace {

using Eigen::Vector3d;

Ray ray(const Vector3d& origin, const Vector3d& towards) {
  return {origin, (towards - origin).normalized()};
}

TEST(Crossover, MeetsAtTheCommonPoint) {
  const Vector3d point(1.0, 2.0, 3.0);
  const Ray a = ray({0.0, 0.0, 5.0}, point);
  const Ray b = ray({4.0, 0.0, 5.0}, point);
  Crossover cross;
  ASSERT_EQ(closest_crossover(a, b, cross), CrossoverStatus::ok);
  EXPECT_NEAR((cross.point_m - point).norm(), 0.0, 1e-12);
  EXPECT_NEAR(cross.miss_m, 0.0, 1e-12);
  EXPECT_NEAR(cross.range_a_m, (point - a.origin).norm(), 1e-12);
  EXPECT_NEAR(cross.range_b_m, (point - b.origin).norm(), 1e-12);
}

TEST(Crossover, OfSkewLinesIsHalfWayAlongTheirCommonPerpendicular) {
  const Ray a{{-1.0, 0.0, 0.0}, Vector3d::UnitX()};
  const Ray b{{0.0, -1.0, 0.5}, Vector3d::UnitY()};
  Crossover cross;
  ASSERT_EQ(closest_crossover(a, b, cross), CrossoverStatus::ok);
  EXPECT_TRUE(cross.point_m.isApprox(Vector3d(0.0, 0.0, 0.25), 1e-12));
  EXPECT_NEAR(cross.miss_m, 0.5, 1e-12);
}

TEST(Crossover, ParallelLinesAreCollinear) {
  Crossover cross;
  EXPECT_EQ(closest_crossover({Vector3d::Zero(), Vector3d::UnitZ()},
                              {Vector3d::UnitX(), Vector3d::UnitZ()}, cross),
            CrossoverStatus::collinear);
  EXPECT_EQ(closest_crossover({Vector3d::Zero(), Vector3d::UnitZ()},
                              {Vector3d::UnitX(), -Vector3d::UnitZ()}, cross),
            CrossoverStatus::collinear);
}

TEST(Crossover, BehindEitherOriginIsBehind) {
  const Vector3d point(0.0, 0.0, -1.0);
  const Ray away_a{{1.0, 0.0, 0.0}, (Vector3d(1.0, 0.0, 0.0) - point).normalized()};
  const Ray towards_b = ray({-1.0, 0.0, 0.0}, point);
  Crossover cross;
  EXPECT_EQ(closest_crossover(away_a, towards_b, cross), CrossoverStatus::behind);
  EXPECT_EQ(closest_crossover(towards_b, away_a, cross), CrossoverStatus::behind);
}

TEST(Crossover, NanIsNoCrossover) {
  Crossover cross;
  const Ray bad{{std::nan(""), 0.0, 0.0}, Vector3d::UnitX()};
  EXPECT_NE(closest_crossover(bad, {Vector3d::Zero(), Vector3d::UnitY()}, cross),
            CrossoverStatus::ok);
}

TEST(Crossover, NoPointOfEitherLineIsCloserToTheOther) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  int valid = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&] { return Vector3d(place(random), place(random), place(random)); };
    const Ray a = ray(any(), any());
    const Ray b = ray(any(), any());
    Crossover cross;
    if (closest_crossover(a, b, cross) != CrossoverStatus::ok) continue;
    ++valid;
    for (const double step : {-0.01, 0.01}) {
      const Vector3d on_a = a.origin + (cross.range_a_m + step) * a.direction;
      const Vector3d on_b = b.origin + cross.range_b_m * b.direction;
      EXPECT_GT((on_a - on_b).norm(), cross.miss_m);
    }
  }
  EXPECT_GT(valid, 200);
}

}  // namespace
}  // namespace dottrack::geometry
