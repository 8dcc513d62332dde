// Ways to move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host_sim/world/meshes.h"
#include "host_sim/world/motions.h"
#include "host_sim/world/rover.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const WayPoints kRound = {{-7.0, -2.0}, {0.0, -2.5}, {7.0, -1.5},
                          {7.5, 2.0},   {0.0, 1.5},  {-6.0, 2.0}};
constexpr double kSpeed_m_s = 0.3;

double turned_rad(const Pose& a, const Pose& b) {
  return a.orientation().angularDistance(b.orientation());
}

TEST(DriveTest, KeepsItsSpeedAndItsHeadingAlongThePath) {
  const Terrain terrain(22.0, 9.0, 2);
  for (const bool closed : {true, false}) {
    const Motion drive = drive_along(terrain, kRound, kSpeed_m_s, closed);
    const double end_s = path_length_m(kRound, closed) / kSpeed_m_s;
    const double step_s = 1e-3;
    for (double t = 0.0; t < end_s - 0.1; t += 0.31) {
      const Pose before = drive(t).value();
      const Pose after = drive(t + step_s).value();
      const Vector2d velocity = (after.position_m - before.position_m).head<2>() / step_s;
      ASSERT_NEAR(velocity.norm(), kSpeed_m_s, 1e-4) << t;
      const Vector2d forward = before.rotation.col(0).head<2>().normalized();
      ASSERT_GT(velocity.dot(forward), kSpeed_m_s * std::cos(1e-3)) << t;
      ASSERT_LT(turned_rad(before, after), 1.5 * step_s) << t;
      ASSERT_LT(std::abs(after.position_m.z() - before.position_m.z()), 0.1 * step_s) << t;
      ASSERT_NEAR(before.rotation.determinant(), 1.0, 1e-12);
      ASSERT_LT(
          (before.rotation * before.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
          1e-12);
    }
  }
}

TEST(DriveTest, HasItsWheelsOnTheGroundAndTiltsWithIt) {
  double steepest = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Terrain terrain(22.0, 9.0, seed);
    const Motion drive = drive_along(terrain, kRound, kSpeed_m_s, true);
    for (double t = 0.0; t < 120.0; t += 0.5) {
      const Pose pose = drive(t).value();
      steepest = std::max(steepest, std::acos(pose.rotation(2, 2)));
      for (const double x : {-kHalfWheelBase_m, 0.0, kHalfWheelBase_m}) {
        for (const double y : {-kHalfTrack_m, kHalfTrack_m}) {
          const Vector3d wheel = pose.to_world({x, y, 0.0});
          ASSERT_NEAR(wheel.z(), terrain.height_m(wheel.head<2>()), 0.03) << seed << ", " << t;
        }
      }
    }
  }
  EXPECT_GT(steepest, radians(4.0));
  EXPECT_LT(steepest, radians(8.0));
}

TEST(DriveTest, PassesThroughItsWayPointsAndBeginsAgainOrStops) {
  const Terrain terrain(22.0, 9.0, 2);
  const double round_s = path_length_m(kRound, true) / kSpeed_m_s;
  const Motion again = drive_along(terrain, kRound, kSpeed_m_s, true);
  EXPECT_LT((again(3.0)->position_m - again(3.0 + round_s)->position_m).norm(), 1e-9);
  const Motion once = drive_along(terrain, kRound, kSpeed_m_s, false);
  EXPECT_LT((once(1e4)->position_m.head<2>() - kRound.back()).norm(), 1e-9);
  EXPECT_LT((once(-5.0)->position_m.head<2>() - kRound.front()).norm(), 1e-9);
  for (const Vector2d& p : kRound) EXPECT_NEAR(distance_to_path_m(kRound, true, p), 0.0, 1e-9);
  EXPECT_NEAR(path_length_m({{0.0, 0.0}, {3.0, 4.0}}, false), 5.0, 1e-9);
  EXPECT_NEAR(distance_to_path_m({{0.0, 0.0}, {3.0, 0.0}}, false, {1.0, 2.0}), 2.0, 1e-9);
}

TEST(DriveTest, ClimbsARampAtItsAngle) {
  Ramp ramp;
  ramp.foot_m = {1.0, 0.5};
  ramp.heading_rad = 0.4;
  const Terrain terrain(22.0, 9.0, 1, ramp);
  const Vector2d forward(cosine(0.4), sine(0.4));
  const Motion drive =
      drive_along(terrain, {ramp.foot_m - 2.0 * forward, ramp.foot_m + 1.5 * forward}, 0.2, false);
  const Pose on_ramp = drive(1e3).value();
  EXPECT_NEAR(std::asin(on_ramp.rotation(2, 0)), radians(25.0), 1e-6);
  EXPECT_NEAR(on_ramp.rotation(2, 1), 0.0, 1e-6);
  EXPECT_NEAR(on_ramp.position_m.z(), 1.5 * tangent(ramp.angle_rad), 1e-6);
  for (double t = 0.0; t < 17.0; t += 0.05) {
    EXPECT_LT(turned_rad(drive(t).value(), drive(t + 0.05).value()), radians(1.0)) << t;
    EXPECT_LT((drive(t)->position_m - drive(t + 0.05)->position_m).norm(), 0.02) << t;
  }
}

TEST(PlacedOnTest, HeadsAsToldAndStandsAsTheDriveDoes) {
  const Terrain terrain(22.0, 9.0, 2);
  const Pose pose = placed_on(terrain, {1.0, 2.0}, 2.5);
  EXPECT_NEAR(std::atan2(pose.rotation(1, 0), pose.rotation(0, 0)), 2.5, 1e-12);
  const Pose there = drive_along(terrain, kRound, kSpeed_m_s, true)(17.0).value();
  const double yaw = std::atan2(there.rotation(1, 0), there.rotation(0, 0));
  const Pose same = placed_on(terrain, there.position_m.head<2>(), yaw);
  EXPECT_LT((same.position_m - there.position_m).norm(), 1e-9);
  EXPECT_LT((same.rotation - there.rotation).norm(), 1e-9);
}

TEST(CraneTest, RunsStraightButForItsVibration) {
  const Vector3d from(-9.0, 1.0, 0.6);
  const Vector3d to(9.0, 1.0, 0.6);
  const Motion crane = crane_line(from, to, 0.25, 0.8, 0.004);
  double farthest = 0.0;
  double tilted = 0.0;
  for (double t = 0.0; t < 72.0; t += 0.01) {
    const Pose pose = crane(t).value();
    const Vector3d off = pose.position_m - (from + 0.25 * t * Vector3d::UnitX());
    EXPECT_EQ(off.z(), 0.0);
    farthest = std::max(farthest, off.norm());
    tilted = std::max(tilted, std::acos(pose.rotation(2, 2)));
    ASSERT_NEAR(pose.rotation.determinant(), 1.0, 1e-12);
  }
  EXPECT_GT(farthest, 0.004);
  EXPECT_LT(farthest, 0.006);
  EXPECT_GT(tilted, radians(0.3));
  EXPECT_LT(tilted, radians(1.2));
  EXPECT_LT((crane(1e3)->position_m - to).norm(), 0.006);
  const Motion still = crane_line(from, to, 0.25, 0.8, 0.0);
  EXPECT_LT((still(10.0)->position_m - Vector3d(-6.5, 1.0, 0.6)).norm(), 1e-12);
}

TEST(CraneTest, RunsOneLineAfterTheOther) {
  const std::vector<CraneLine> lines = {{{0.0, 0.0, 1.0}, {2.0, 0.0, 1.0}, 0.5, 0.0, 0.0},
                                        {{5.0, 1.0, 1.0}, {5.0, 4.0, 1.0}, 0.25, 0.0, 0.0}};
  const std::vector<LineTimes> times = crane_line_times(lines);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].from_s, 0.0);
  EXPECT_EQ(times[0].to_s, 4.0);
  EXPECT_EQ(times[1].from_s, 4.0);
  EXPECT_EQ(times[1].to_s, 16.0);
  const Motion crane = crane_lines(lines);
  EXPECT_LT((crane(3.0)->position_m - Vector3d(1.5, 0.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((crane(8.0)->position_m - Vector3d(5.0, 2.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((crane(99.0)->position_m - Vector3d(5.0, 4.0, 1.0)).norm(), 1e-12);
}

TEST(SwitchedTest, GoesComesAndIsCarriedElsewhere) {
  const Motion here = stand_at(upright({1.0, 0.0, 0.0}));
  const Motion there = stand_at(upright({5.0, 0.0, 0.0}));
  const Motion motion = switched({{0.0, here}, {2.0, Motion{}}, {4.0, there}, {6.0, here}});
  EXPECT_FALSE(motion(-0.1).has_value());
  EXPECT_EQ(motion(1.9)->position_m.x(), 1.0);
  EXPECT_FALSE(motion(2.0).has_value());
  EXPECT_FALSE(motion(3.9).has_value());
  EXPECT_EQ(motion(4.0)->position_m.x(), 5.0);
  EXPECT_EQ(motion(99.0)->position_m.x(), 1.0);
}

TEST(SurveyPlacesTest, StandsAtOnePlaceAfterTheOther) {
  const Motion motion = survey_places({upright({1.0, 0.0, 0.0}), upright({2.0, 0.0, 0.0})}, 1.5);
  EXPECT_EQ(motion(0.0)->position_m.x(), 1.0);
  EXPECT_EQ(motion(1.49)->position_m.x(), 1.0);
  EXPECT_EQ(motion(1.5)->position_m.x(), 2.0);
  EXPECT_EQ(motion(99.0)->position_m.x(), 2.0);
}

TEST(WalkTest, KeepsUprightWithFeetAtTheGround) {
  const Terrain terrain(22.0, 9.0, 2);
  const Motion motion = walk(terrain, kRound, 1.2, true);
  for (double t = 0.0; t < 40.0; t += 0.05) {
    const Pose pose = motion(t).value();
    EXPECT_GT(pose.rotation(2, 2), std::cos(radians(3.0)));
    const double above_m = pose.position_m.z() - terrain.height_m(pose.position_m.head<2>());
    EXPECT_NEAR(above_m, -0.01, 0.02);
    EXPECT_LT(distance_to_path_m(kRound, true, pose.position_m.head<2>()), 0.03);
  }
}

}  // namespace
}  // namespace dottrack::host_sim
