// A target learned from a drive, against where its dots really are.

#include "app/workstation/survey/target_bundle.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "app/core/geometry/orientation.h"
#include "tests/unit/workstation/survey/recorded_drive.h"

namespace dottrack::workstation {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// The rig with every dot of the target off by so much in each coordinate.
core::Rig misled(const core::Rig& rig, double sigma_m, std::uint64_t seed) {
  core::Rig wrong = rig;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, sigma_m);
  for (auto& dot : wrong.target.dots) {
    dot.position_m += Vector3d{normal(random), normal(random), normal(random)};
  }
  return wrong;
}

// Learned minus true, after the truth is laid on the learned dots.
VectorXd errors(const core::Rig& truth, const LearnedTarget& learned) {
  std::vector<Vector3d> true_m;
  std::vector<Vector3d> learned_m;
  for (std::size_t i = 0; i < learned.dots.size(); ++i) {
    true_m.push_back(truth.target.dots[i].position_m);
    learned_m.push_back(learned.dots[i].position_m);
  }
  geometry::RigidMotion motion;
  EXPECT_EQ(geometry::absolute_orientation(true_m, learned_m, motion),
            geometry::OrientationStatus::ok);
  VectorXd error(static_cast<Eigen::Index>(3 * true_m.size()));
  for (std::size_t i = 0; i < true_m.size(); ++i) {
    error.segment<3>(static_cast<Eigen::Index>(3 * i)) = learned_m[i] - motion * true_m[i];
  }
  return error;
}

// Over the directions in which the covariance is not empty.
double normalised_squared(const VectorXd& error, const Eigen::MatrixXd& covariance, int& freedom) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  double sum = 0.0;
  freedom = 0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double variance = solver.eigenvalues()[i];
    if (variance < 1e-6 * solver.eigenvalues().maxCoeff()) continue;
    const double along = solver.eigenvectors().col(i).dot(error);
    sum += along * along / variance;
    ++freedom;
  }
  return sum;
}

TEST(TargetBundle, LearnsDotsThatWereSurveyedFiveMillimetresWrong) {
  const test::RecordedDrive drive;
  const core::Rig wrong = misled(drive.rig, 0.005, 3);
  const auto learned = learn_target(wrong, drive.drive({.ticks = 200, .seed = 4}));
  ASSERT_TRUE(learned) << learned.error().message;
  const VectorXd error = errors(drive.rig, *learned);
  for (std::size_t i = 0; i < learned->dots.size(); ++i) {
    EXPECT_LT(error.segment<3>(static_cast<Eigen::Index>(3 * i)).norm(), 0.0005) << i;
    EXPECT_GT(learned->dots[i].views, 100U);
  }
  EXPECT_LT(learned->rms_px, 0.1);
  EXPECT_GT(learned->rms_px, 0.03);
}

TEST(TargetBundle, ItsUncertaintyIsTrue) {
  constexpr int kDrives = 20;
  double sum = 0.0;
  int freedom = 0;
  for (int k = 0; k < kDrives; ++k) {
    const auto seed = static_cast<std::uint64_t>(k + 1);
    const test::RecordedDrive drive(seed);
    const auto learned = learn_target(misled(drive.rig, 0.005, seed),
                                      drive.drive({.ticks = 60, .seed = 100 + seed}));
    ASSERT_TRUE(learned) << learned.error().message;
    int own = 0;
    sum += normalised_squared(errors(drive.rig, *learned), learned->covariance, own);
    EXPECT_EQ(own, 9);
    freedom += own;
  }
  ASSERT_EQ(freedom, 9 * kDrives);
  // Never less than white noise makes it, and noise that groups share is guarded against: the
  // uncertainty may be a little too large. 180 degrees of freedom: 1 +- 0.105.
  EXPECT_LT(sum / freedom, 1.3);
  EXPECT_GT(sum / freedom, 0.5);
}

TEST(TargetBundle, LaysTheLearnedDotsOnTheGivenOnes) {
  const test::RecordedDrive drive;
  const core::Rig wrong = misled(drive.rig, 0.005, 8);
  const auto learned = learn_target(wrong, drive.drive({.ticks = 60, .seed = 4}));
  ASSERT_TRUE(learned);
  Vector3d sum = Vector3d::Zero();
  Vector3d turn = Vector3d::Zero();
  for (std::size_t i = 0; i < learned->dots.size(); ++i) {
    sum += learned->dots[i].moved_m;
    turn += wrong.target.dots[i].position_m.cross(learned->dots[i].moved_m);
  }
  EXPECT_LT(sum.norm(), 1e-6);
  EXPECT_LT(turn.norm(), 1e-6);
}

TEST(TargetBundle, RefusesADriveThatSaysTooLittle) {
  const test::RecordedDrive drive;
  auto ticks = drive.drive({.ticks = 60});
  const auto few = learn_target(drive.rig, std::span(ticks).first(5));
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().message, "5 ticks have a pose; expected 10 or more, in different places");
  for (auto& tick : ticks) std::erase_if(tick.views, [](const auto& v) { return v.dot == 2; });
  const auto unseen = learn_target(drive.rig, ticks);
  ASSERT_FALSE(unseen);
  EXPECT_EQ(unseen.error().message, "dot 2 of the target was seen 0 times; expected 20 or more");
}

}  // namespace
}  // namespace dottrack::workstation
