#include "tests/board/harness/truth_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dottrack::board {
namespace {

PoseOf moved(double x_m, double yaw_deg) {
  const double yaw = yaw_deg * std::acos(-1.0) / 180.0;
  return {Eigen::Vector3d(x_m, 0.0, 0.0),
          Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()))};
}

TEST(TruthCheck, CountsAndMeasures) {
  TruthCheck check;
  check.add(moved(0.03, 1.0), moved(0.0, 0.0));
  check.add(moved(-0.04, -3.0), moved(0.0, 0.0));
  EXPECT_EQ(check.poses(), 2U);
  EXPECT_EQ(check.wrong(), 0U);
  EXPECT_NEAR(check.position_rms_m(), std::sqrt((9e-4 + 16e-4) / 2.0), 1e-12);
  EXPECT_NEAR(check.position_max_m(), 0.04, 1e-12);
  EXPECT_NEAR(check.attitude_rms_deg(), std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(check.attitude_max_deg(), 3.0, 1e-6);
}

TEST(TruthCheck, FarOffIsWrongByPlaceOrByAttitude) {
  TruthCheck check;
  check.add(moved(0.11, 0.0), moved(0.0, 0.0));
  check.add(moved(0.0, 5.5), moved(0.0, 0.0));
  EXPECT_EQ(check.wrong(), 2U);
}

TEST(TruthCheck, NotANumberIsWrong) {
  TruthCheck check;
  check.add(moved(std::numeric_limits<double>::quiet_NaN(), 0.0), moved(0.0, 0.0));
  EXPECT_EQ(check.wrong(), 1U);
}

TEST(TruthCheck, AQuaternionAndItsNegativeAreOneAttitude) {
  PoseOf turned = moved(0.0, 40.0);
  PoseOf negative = turned;
  negative.orientation.coeffs() *= -1.0;
  TruthCheck check;
  check.add(turned, negative);
  EXPECT_EQ(check.wrong(), 0U);
  EXPECT_NEAR(check.attitude_max_deg(), 0.0, 1e-5);
}

}  // namespace
}  // namespace dottrack::board
