// Frames against attitudes worked out by hand.

#include "app/workstation/mavlink/ned_conversion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/mavlink/poses.h"

namespace dottrack::workstation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::plain_pose;
using testing::set_covariance;
using testing::set_orientation;
using testing::yawed;

constexpr double kQuarter = std::numbers::pi / 2.0;
constexpr double kDegree = std::numbers::pi / 180.0;

double heading_of(const Quaterniond& enu_flu) {
  return euler_angles(ned_frd_from_enu_flu(enu_flu)).yaw;
}

void expect_near(const Vector3d& value, const Vector3d& expected, double tolerance = 1e-12) {
  EXPECT_LT((value - expected).norm(), tolerance)
      << value.transpose() << " instead of " << expected.transpose();
}

TEST(NedConversion, PutsTheWorldsAxesWhereTheyBelong) {
  expect_near(ned_from_enu(Vector3d(1, 0, 0)), {0, 1, 0});   // x is east
  expect_near(ned_from_enu(Vector3d(0, 1, 0)), {1, 0, 0});   // y is north
  expect_near(ned_from_enu(Vector3d(0, 0, 1)), {0, 0, -1});  // z is up
  expect_near(frd_from_flu({1, 2, 3}), {1, -2, -3});
}

TEST(NedConversion, KnowsHeadings) {
  EXPECT_NEAR(heading_of(yawed(kQuarter)), 0.0, 1e-12);              // north
  EXPECT_NEAR(heading_of(yawed(0.0)), kQuarter, 1e-12);              // east
  EXPECT_NEAR(heading_of(yawed(-kQuarter)), 2.0 * kQuarter, 1e-12);  // south
  EXPECT_NEAR(heading_of(yawed(2.0 * kQuarter)), -kQuarter, 1e-12);  // west
  EXPECT_NEAR(heading_of(yawed(60.0 * kDegree)), 30.0 * kDegree, 1e-12);
}

TEST(NedConversion, MakesLevelAndNorthTheIdentity) {
  const Quaterniond attitude = ned_frd_from_enu_flu(yawed(kQuarter));
  EXPECT_NEAR(attitude.w(), 1.0, 1e-12);
  EXPECT_LT(attitude.vec().norm(), 1e-12);
}

// In our frames a nose that rises turns by a negative angle about y, which is left; right of an
// aircraft goes down with a positive angle about x in both.
TEST(NedConversion, KnowsPitchAndRoll) {
  const Quaterniond climbing = yawed(kQuarter) * Quaterniond(AngleAxisd(-0.2, Vector3d::UnitY()));
  EXPECT_NEAR(euler_angles(ned_frd_from_enu_flu(climbing)).pitch, 0.2, 1e-12);
  const Quaterniond banking = yawed(0.0) * Quaterniond(AngleAxisd(0.3, Vector3d::UnitX()));
  const EulerAngles banked = euler_angles(ned_frd_from_enu_flu(banking));
  EXPECT_NEAR(banked.roll, 0.3, 1e-12);
  EXPECT_NEAR(banked.pitch, 0.0, 1e-12);
  EXPECT_NEAR(banked.yaw, kQuarter, 1e-12);
}

TEST(NedConversion, NoseUpIsAPitchOfAQuarterTurn) {
  const Quaterniond up(AngleAxisd(-kQuarter, Vector3d::UnitY()));
  const Quaterniond attitude = ned_frd_from_enu_flu(up);
  expect_near(attitude * Vector3d(1, 0, 0), {0, 0, -1});  // the nose is against down
  const EulerAngles angles = euler_angles(attitude);
  EXPECT_NEAR(angles.pitch, kQuarter, 1e-7);
  EXPECT_EQ(angles.roll, 0.0);
  EXPECT_NEAR(angles.yaw, kQuarter, 1e-7);  // it went up from heading east
}

TEST(NedConversion, SignOfTheQuaternionIsContinuous) {
  Quaterniond before = ned_frd_from_enu_flu(yawed(0.0));
  for (int i = 1; i <= 720; ++i) {
    const double half = 0.5 * i * kDegree;
    const Quaterniond next = ned_frd_from_enu_flu({std::cos(half), 0.0, 0.0, std::sin(half)});
    EXPECT_GT(next.dot(before), 0.99) << i;
    before = next;
  }
}

TEST(NedConversion, TurnsTheEllipsoidWithTheAxes) {
  Matrix6d enu = Matrix6d::Zero();
  enu.diagonal() << 1, 4, 9, 16, 25, 36;
  enu(0, 2) = enu(2, 0) = 0.5;  // east and up
  enu(1, 5) = enu(5, 1) = 0.7;  // north and the rotation about up
  enu(3, 4) = enu(4, 3) = 0.9;  // the rotations about east and north
  Matrix6d expected = Matrix6d::Zero();
  expected.diagonal() << 4, 1, 9, 25, 16, 36;
  expected(1, 2) = expected(2, 1) = -0.5;
  expected(0, 5) = expected(5, 0) = -0.7;
  expected(3, 4) = expected(4, 3) = 0.9;
  EXPECT_TRUE(ned_from_enu(enu).isApprox(expected, 1e-14)) << ned_from_enu(enu);
}

TEST(NedPose, TakesVelocityToTheBody) {
  dottrack_pose pose = plain_pose();
  set_orientation(pose, yawed(kQuarter));  // forward is the world's y
  pose.has_velocity = true;
  pose.velocity_m_s[0] = 3.0;  // to the right
  pose.velocity_m_s[1] = 2.0;  // forward
  pose.velocity_m_s[2] = 1.0;  // up
  pose.has_rates = true;
  pose.rates_rad_s[0] = 0.1;
  pose.rates_rad_s[1] = 0.2;
  pose.rates_rad_s[2] = 0.3;
  const NedPose ned = ned_pose(pose);
  ASSERT_TRUE(ned.velocity_m_s.has_value());
  expect_near(*ned.velocity_m_s, {2, 3, -1});
  ASSERT_TRUE(ned.rates_rad_s.has_value());
  expect_near(*ned.rates_rad_s, {0.1, -0.2, -0.3});
}

TEST(NedPose, KnowsNoMoreThanThePose) {
  const NedPose ned = ned_pose(plain_pose());
  EXPECT_FALSE(ned.covariance.has_value());
  EXPECT_FALSE(ned.velocity_m_s.has_value());
  EXPECT_FALSE(ned.rates_rad_s.has_value());
}

TEST(NedPose, ReadsTheCovarianceByRows) {
  dottrack_pose pose = plain_pose();
  Matrix6d covariance = Matrix6d::Identity();
  covariance(0, 5) = covariance(5, 0) = 0.25;  // east and the rotation about up
  set_covariance(pose, covariance);
  const NedPose ned = ned_pose(pose);
  ASSERT_TRUE(ned.covariance.has_value());
  EXPECT_DOUBLE_EQ((*ned.covariance)(1, 5), -0.25);
}

}  // namespace
}  // namespace dottrack::workstation
