#include "app/core/estimation/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dottrack::estimation {
namespace {

using std::chrono::milliseconds;

core::Pose pose(const Eigen::Vector3d& position_m, const Eigen::Quaterniond& orientation) {
  core::Pose pose;
  pose.position_m = position_m;
  pose.orientation = orientation;
  return pose;
}

Time at(int ms) {
  return Time(milliseconds(ms));
}

TEST(Motion, OfAVehicleThatDrivesAndTurnsOnTheSpot) {
  const Eigen::Quaterniond east(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond later(Eigen::AngleAxisd(0.3 + 0.05, Eigen::Vector3d::UnitZ()));
  const core::Motion motion =
      motion_between(pose({1, 2, 3}, east), at(100), pose({1.2, 1.9, 3}, later), at(200));
  ASSERT_TRUE(motion.known);
  EXPECT_LT((motion.velocity_m_s - Eigen::Vector3d(2, -1, 0)).norm(), 1e-12);
  EXPECT_LT((motion.rates_rad_s - Eigen::Vector3d(0, 0, 0.5)).norm(), 1e-12);
}

TEST(Motion, RatesAreThoseOfAGyroscopeOnTheVehicle) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond before =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized();
    const Eigen::Vector3d rates =
        Eigen::Vector3d(normal(random), normal(random), normal(random)) * 5.0;
    const double dt_s = 0.02;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(rates.norm() * dt_s, rates.normalized()));
    Eigen::Quaterniond after = before * turn;
    if (i % 2 == 0) after.coeffs() *= -1.0;  // the same attitude
    const core::Motion motion =
        motion_between(pose({0, 0, 0}, before), at(0), pose({0, 0, 0}, after), at(20));
    ASSERT_TRUE(motion.known);
    ASSERT_LT((motion.rates_rad_s - rates).norm(), 1e-9) << i;
  }
}

TEST(Motion, StandingStillIsNoMotion) {
  const core::Pose still = pose({1, 2, 3}, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));
  const core::Motion motion = motion_between(still, at(0), still, at(33));
  ASSERT_TRUE(motion.known);
  EXPECT_EQ(motion.velocity_m_s.norm(), 0.0);
  EXPECT_EQ(motion.rates_rad_s.norm(), 0.0);
}

TEST(Motion, WithoutTimeInBetweenIsNotKnown) {
  const core::Pose any = pose({1, 2, 3}, Eigen::Quaterniond::Identity());
  EXPECT_FALSE(motion_between(any, at(7), any, at(7)).known);
  EXPECT_FALSE(motion_between(any, at(8), any, at(7)).known);
}

}  // namespace
}  // namespace dottrack::estimation
