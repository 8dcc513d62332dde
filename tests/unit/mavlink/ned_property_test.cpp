// What holds of every pose, whichever it is.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "app/workstation/mavlink/ned_conversion.h"
#include "tests/unit/mavlink/poses.h"

namespace dottrack::workstation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::RandomPoses;

constexpr int kPoses = 2000;

Matrix3d by_columns(Vector3d (*turn)(const Vector3d&)) {
  Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.col(i) = turn(Vector3d::Unit(i));
  return matrix;
}

Quaterniond from_euler(const EulerAngles& angles) {
  return AngleAxisd(angles.yaw, Vector3d::UnitZ()) * AngleAxisd(angles.pitch, Vector3d::UnitY()) *
         AngleAxisd(angles.roll, Vector3d::UnitX());
}

TEST(NedProperty, AttitudeIsTheProductOfTheTurns) {
  const Matrix3d ned_enu = by_columns([](const Vector3d& v) { return ned_from_enu(v); });
  const Matrix3d frd_flu = by_columns([](const Vector3d& v) { return frd_from_flu(v); });
  EXPECT_DOUBLE_EQ(ned_enu.determinant(), 1.0);
  EXPECT_DOUBLE_EQ(frd_flu.determinant(), 1.0);
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Quaterniond q = random.rotation();
    const Matrix3d expected = ned_enu * q.toRotationMatrix() * frd_flu.transpose();
    const Quaterniond attitude = ned_frd_from_enu_flu(q);
    ASSERT_LT((attitude.toRotationMatrix() - expected).norm(), 1e-12) << i;
    ASSERT_NEAR(attitude.norm(), 1.0, 1e-12) << i;
  }
}

TEST(NedProperty, ThereAndBackIsTheSame) {
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Vector3d v = random.vector();
    ASSERT_EQ(ned_from_enu(Vector3d(ned_from_enu(v))), v);
    ASSERT_EQ(frd_from_flu(frd_from_flu(v)), v);
    const Matrix6d c = random.covariance();
    ASSERT_LT((ned_from_enu(ned_from_enu(c)) - c).norm(), 1e-12 * c.norm()) << i;
  }
}

TEST(NedProperty, AngleBetweenAttitudesStays) {
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Quaterniond a = random.rotation();
    const Quaterniond b = random.rotation();
    const double after = ned_frd_from_enu_flu(a).angularDistance(ned_frd_from_enu_flu(b));
    ASSERT_NEAR(after, a.angularDistance(b), 1e-7) << i;
  }
}

TEST(NedProperty, EigenvaluesOfTheCovarianceStay) {
  using Solver = Eigen::SelfAdjointEigenSolver<Matrix6d>;
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Matrix6d enu = random.covariance();
    const Matrix6d ned = ned_from_enu(enu);
    ASSERT_EQ(ned, Matrix6d(ned.transpose())) << i;
    const auto before = Solver(enu).eigenvalues().eval();
    const auto after = Solver(ned).eigenvalues().eval();
    ASSERT_LT((before - after).norm(), 1e-11 * before.norm()) << i;
  }
}

// A small error of the pose in our frames is the same small error in the autopilot's.
TEST(NedProperty, CovarianceIsThatOfTheTurnedErrors) {
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Quaterniond q = random.rotation();
    const Vector3d error = 1e-6 * random.vector();
    const Quaterniond off = Quaterniond(AngleAxisd(error.norm(), error.normalized())) * q;
    const Quaterniond change = ned_frd_from_enu_flu(off) * ned_frd_from_enu_flu(q).conjugate();
    const Vector3d seen = 2.0 * std::copysign(1.0, change.w()) * change.vec();
    ASSERT_LT((seen - ned_from_enu(error)).norm(), 1e-11) << i;
  }
}

TEST(NedProperty, EulerAnglesAreTheAttitude) {
  RandomPoses random;
  for (int i = 0; i < kPoses; ++i) {
    const Quaterniond q = random.rotation();
    ASSERT_LT(from_euler(euler_angles(q)).angularDistance(q), 1e-7) << i;
  }
}

TEST(NedProperty, EulerAnglesHoldUpWithTheNoseStraightUpOrDown) {
  RandomPoses random;
  int upright = 0;
  for (int i = 0; i < kPoses; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double off = std::pow(10.0, -(i % 18)) * random.number();
    const EulerAngles steep{.roll = 3.0 * std::tanh(random.number()),
                            .pitch = side * (M_PI / 2.0 - std::abs(off)),
                            .yaw = 3.0 * std::tanh(random.number())};
    const Quaterniond q = from_euler(steep);
    const EulerAngles angles = euler_angles(q);
    ASSERT_TRUE(std::isfinite(angles.roll + angles.pitch + angles.yaw)) << i;
    ASSERT_LT(from_euler(angles).angularDistance(q), 3e-6) << i;
    if (angles.roll == 0.0) ++upright;
  }
  EXPECT_GT(upright, kPoses / 4);
}

}  // namespace
}  // namespace dottrack::workstation
