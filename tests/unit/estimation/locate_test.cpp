#include "app/core/estimation/locate.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <random>
#include <vector>

namespace dottrack::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

core::Target four_dots() {
  core::Target target;
  target.dots = {{{0.4, 0.3, 0.0}, 0.1, {}},
                 {{-0.5, 0.2, 0.1}, 0.1, {}},
                 {{-0.3, -0.3, 0.0}, 0.1, {}},
                 {{0.3, -0.2, 0.05}, 0.1, {}}};
  return target;
}

// Depth is known five times worse than the place across: what crossed rays give.
Matrix3d lengthy_covariance(double sigma_m, const Vector3d& along) {
  return sigma_m * sigma_m * (Matrix3d::Identity() + 24.0 * along * along.transpose());
}

class LocateTest : public testing::Test {
 protected:
  std::vector<LocatedDot> see(double sigma_m) {
    std::vector<LocatedDot> dots;
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < target_.dots.size(); ++i) {
      const Vector3d along = Vector3d(0.3 * static_cast<double>(i), 0.5, 1.0).normalized();
      const Matrix3d covariance = lengthy_covariance(std::max(sigma_m, 1e-6), along);
      Vector3d noise = Vector3d::Zero();
      if (sigma_m > 0.0) {
        noise = covariance.llt().matrixL() *
                Vector3d(normal(random_), normal(random_), normal(random_));
      }
      dots.push_back(triangulated_dot(
          i, rotation_ * target_.dots[i].position_m + position_m_ + noise, covariance));
    }
    return dots;
  }

  core::Target target_ = four_dots();
  Quaterniond rotation_ =
      Eigen::AngleAxisd(1.1, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.1, Vector3d::UnitX());
  Vector3d position_m_{3.0, -2.0, 0.5};
  std::mt19937 random_{4};
};

TEST_F(LocateTest, RecoversThePose) {
  core::Pose pose;
  ASSERT_EQ(locate(target_, see(0.0), 0.01, pose), LocateStatus::ok);
  EXPECT_LT((pose.position_m - position_m_).norm(), 1e-9);
  EXPECT_LT(pose.orientation.angularDistance(rotation_), 1e-7);
  EXPECT_LT(pose.rms_residual_m, 1e-9);
}

TEST_F(LocateTest, WeighingByCovarianceBeatsTheUnweightedFit) {
  double weighted2 = 0.0;
  double unweighted2 = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<LocatedDot> dots = see(0.002);
    core::Pose pose;
    ASSERT_EQ(locate(target_, dots, 1.0, pose), LocateStatus::ok);
    weighted2 += (pose.position_m - position_m_).squaredNorm();
    for (LocatedDot& dot : dots) dot.information = 1e6 * Matrix3d::Identity();
    ASSERT_EQ(locate(target_, dots, 1.0, pose), LocateStatus::ok);
    unweighted2 += (pose.position_m - position_m_).squaredNorm();
  }
  EXPECT_LT(weighted2, unweighted2);
}

// The mean of the normalised squared error is 6 where the covariance is true; the variance factor,
// never below one, makes it somewhat cautious.
TEST_F(LocateTest, TheCovarianceIsTrue) {
  double sum = 0.0;
  constexpr int kTrials = 5000;
  for (int trial = 0; trial < kTrials; ++trial) {
    core::Pose pose;
    ASSERT_EQ(locate(target_, see(0.002), 1.0, pose), LocateStatus::ok);
    const Eigen::AngleAxisd turn(pose.orientation * rotation_.conjugate());
    Vector6d error;
    error << pose.position_m - position_m_, turn.angle() * turn.axis();
    sum += error.dot(pose.covariance.ldlt().solve(error));
  }
  EXPECT_GT(sum / kTrials, 4.0);
  EXPECT_LT(sum / kTrials, 6.2);
}

TEST_F(LocateTest, ResidualsBeyondTheDotsCovariancesWidenThePoses) {
  const std::vector<LocatedDot> dots = see(0.002);
  core::Pose calm;
  ASSERT_EQ(locate(target_, dots, 1.0, calm), LocateStatus::ok);
  std::vector<LocatedDot> odd = dots;
  odd[2].position_m += Vector3d(0.05, 0.0, 0.0);
  core::Pose wide;
  ASSERT_EQ(locate(target_, odd, 1.0, wide), LocateStatus::ok);
  EXPECT_GT(wide.covariance(0, 0), 10.0 * calm.covariance(0, 0));
}

TEST_F(LocateTest, SaysWhyThereIsNoPose) {
  core::Pose pose;
  std::vector<LocatedDot> dots = see(0.0);
  EXPECT_EQ(locate(target_, {dots.data(), 2}, 0.01, pose), LocateStatus::too_few_dots);

  std::vector<LocatedDot> bent = dots;
  bent[0].position_m.z() += 0.1;
  EXPECT_EQ(locate(target_, bent, 0.01, pose), LocateStatus::residual);
  EXPECT_GT(pose.rms_residual_m, 0.01);

  rotation_ = Eigen::AngleAxisd(3.0, Vector3d::UnitX());
  EXPECT_EQ(locate(target_, see(0.0), 0.01, pose), LocateStatus::upside_down);
  target_.upright = false;
  EXPECT_EQ(locate(target_, see(0.0), 0.01, pose), LocateStatus::ok);

  target_.dots = {
      {{0.0, 0.0, 0.0}, 0.1, {}}, {{0.1, 0.0, 0.0}, 0.1, {}}, {{0.3, 0.0, 0.0}, 0.1, {}}};
  EXPECT_EQ(locate(target_, see(0.0), 0.01, pose), LocateStatus::degenerate);
}

TEST_F(LocateTest, AnyThreeOfTheDotsWillDo) {
  const std::vector<LocatedDot> all = see(0.0);
  for (std::size_t missing = 0; missing < 4; ++missing) {
    std::vector<LocatedDot> some = all;
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(missing));
    core::Pose pose;
    ASSERT_EQ(locate(target_, some, 0.01, pose), LocateStatus::ok);
    EXPECT_LT((pose.position_m - position_m_).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace dottrack::estimation
