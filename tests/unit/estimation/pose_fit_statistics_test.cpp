// The pose from all views, over thousands of poses: its accuracy, the truth of its covariance, and
// what becomes of views that are wrong.

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/estimation/pose_fit.h"
#include "tests/unit/estimation/room_of_dots.h"

namespace dottrack::estimation {
namespace {

using test::error_of;
using test::RoomOfDots;
using test::Vector3d;

constexpr double kSigma_px = 0.03;

// 95 % of ellipsoids with six degrees of freedom hold a squared error up to this.
constexpr double kSixDegrees95 = 12.592;

class PoseFitStatistics : public testing::Test {
 protected:
  PoseFitStatus fit(const DotObservations& views, const geometry::RigidMotion& start) {
    PoseFitter fitter(room_.rig);
    return fitter.fit(as_span(views), {}, start, DotSpread::none(), fit_);
  }

  RoomOfDots room_;
  PoseFit fit_;
};

// The mean of the normalised squared error is 6 and 95 of 100 ellipsoids hold the truth where the
// covariance is true; over 20,000 poses the mean is known to 0.05.
TEST_F(PoseFitStatistics, TheCovarianceIsTrue) {
  constexpr int kPoses = 20000;
  double sum = 0.0;
  int within = 0;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    ASSERT_EQ(fit(room_.see(truth, kSigma_px), room_.near(truth)), PoseFitStatus::ok);
    const double squared = test::nees(fit_.pose, truth);
    sum += squared;
    within += squared < kSixDegrees95 ? 1 : 0;
  }
  const double band = 1.96 * std::sqrt(12.0 / kPoses);
  EXPECT_NEAR(sum / kPoses, 6.0, band);
  EXPECT_NEAR(static_cast<double>(within) / kPoses, 0.95, 0.005);
}

// Cramer and Rao's bound is the inverse of the information at the truth.
TEST_F(PoseFitStatistics, IsAsGoodAsTheCentresAllow) {
  constexpr int kPoses = 4000;
  Vector6d squared = Vector6d::Zero();
  Vector6d bound = Vector6d::Zero();
  for (int i = 0; i < kPoses; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    const DotObservations views = room_.see(truth, kSigma_px);
    ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
    squared += error_of(fit_.pose, truth).cwiseAbs2();
    const Eccentricities offs(views.size(), Eigen::Vector2d::Zero());
    ViewRows rows;
    linearise(room_.rig, as_span(views), offs, {}, truth, 0.0, rows);
    Matrix6d information = Matrix6d::Zero();
    for (const ViewRow& row : rows) information += row.jacobian.transpose() * row.jacobian;
    bound += information.inverse().diagonal();
  }
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_LT(std::sqrt(squared[axis] / bound[axis]), 1.03) << axis;
  }
}

// Of every dot another view is wrong, by 0.3 to 3 px.
TEST_F(PoseFitStatistics, AWrongViewIsLeftOutAndTheDotStays) {
  std::uniform_real_distribution<double> off(0.3, 3.0);
  double sum = 0.0;
  int right_kept = 0;
  constexpr int kPoses = 2000;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views = room_.see(truth, kSigma_px);
    std::array<bool, 25> wrong{};
    for (std::size_t dot = 0; dot < 5; ++dot) {
      const std::size_t view = 5 * ((dot + static_cast<std::size_t>(i)) % 5) + dot;
      const double angle = 6.28 * off(room_.random);
      views[view].centre_px +=
          off(room_.random) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      wrong[view] = true;
    }
    ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
    for (std::size_t view = 0; view < views.size(); ++view) {
      if (wrong[view]) {
        EXPECT_FALSE(fit_.views[view].used) << i << " " << view;
      } else {
        right_kept += fit_.views[view].used ? 1 : 0;
      }
    }
    sum += test::nees(fit_.pose, truth);
  }
  EXPECT_GT(right_kept, static_cast<int>(0.998 * 20 * kPoses));
  EXPECT_NEAR(sum / kPoses, 6.0, 3.0 * std::sqrt(12.0 / kPoses));
}

// Every camera stands and looks a little otherwise than its model says, and the tracker knows by
// how much that may be: the pose's covariance has it in, and tells it apart.
TEST_F(PoseFitStatistics, TheModelsOwnCovarianceEntersAndDoesNotAverageOut) {
  const test::WrongModels wrong{.shift_m = 0.001, .turn_px = 0.08};
  const std::vector<core::Camera> said = acquisition::test::ceiling_cameras();
  wrong.tell(room_.rig);
  constexpr int kHalls = 4000;
  double sum = 0.0;
  double without = 0.0;
  double systematic = 0.0;
  double total = 0.0;
  for (int i = 0; i < kHalls; ++i) {
    const std::vector<core::Camera> true_cameras = wrong.draw(said, room_.random);
    const geometry::RigidMotion truth = room_.somewhere();
    ASSERT_EQ(fit(room_.see(truth, kSigma_px, true_cameras), room_.near(truth)), PoseFitStatus::ok);
    sum += test::nees(fit_.pose, truth);
    systematic += fit_.systematic.diagonal().head<3>().sum();
    total += fit_.pose.covariance.diagonal().head<3>().sum();
    core::Pose forgetful = fit_.pose;
    forgetful.covariance -= fit_.systematic;
    without += test::nees(forgetful, truth);
  }
  EXPECT_NEAR(sum / kHalls, 6.0, 4.0 * std::sqrt(12.0 / kHalls));
  EXPECT_GT(without / kHalls, 12.0);
  EXPECT_GT(systematic, 0.5 * total);
  EXPECT_LT(systematic, 0.99 * total);
}

// All cameras were placed by a survey that is off itself: their models are wrong by the same, and
// more views do not help.
TEST_F(PoseFitStatistics, WhatTheModelsHaveInCommonDoesNotAverageOutOverCameras) {
  constexpr double kShift_m = 0.001;
  constexpr double kShared = 0.8;
  const std::vector<core::Camera> said = acquisition::test::ceiling_cameras();
  for (core::Camera& camera : room_.rig.cameras) {
    for (int axis = 0; axis < 3; ++axis) {
      geometry::Cahv wrong = std::get<geometry::Cahv>(camera.model);
      wrong.c[axis] += kShift_m;
      camera.model_errors.push_back(wrong);
    }
  }
  core::ModelCorrelations correlations;
  for (std::size_t a = 0; a < room_.rig.cameras.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        correlations.set({a, axis}, {b, axis}, kShared);
      }
    }
  }
  std::normal_distribution<double> normal(0.0, kShift_m);
  const auto shift = [&] {
    return Vector3d(normal(room_.random), normal(room_.random), normal(room_.random));
  };
  constexpr int kHalls = 4000;
  double sum = 0.0;
  double without = 0.0;
  for (int i = 0; i < kHalls; ++i) {
    std::vector<core::Camera> true_cameras = said;
    const Vector3d common = std::sqrt(kShared) * shift();
    for (core::Camera& camera : true_cameras) {
      std::get<geometry::Cahv>(camera.model).c += common + std::sqrt(1.0 - kShared) * shift();
    }
    const geometry::RigidMotion truth = room_.somewhere();
    const DotObservations views = room_.see(truth, kSigma_px, true_cameras);
    room_.rig.model_correlations = correlations;
    ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
    sum += test::nees(fit_.pose, truth);
    room_.rig.model_correlations = {};
    ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
    without += test::nees(fit_.pose, truth);
  }
  EXPECT_NEAR(sum / kHalls, 6.0, 4.0 * std::sqrt(12.0 / kHalls));
  EXPECT_GT(without / kHalls, 9.0);
}

// Every target is put together a little otherwise than its file says, by as much as it says.
TEST_F(PoseFitStatistics, WhereTheDotsMayBeEntersAndDoesNotAverageOut) {
  constexpr double kOff_m = 0.0005;
  room_.rig.target.dot_sigma_m = kOff_m;
  std::normal_distribution<double> normal(0.0, kOff_m);
  constexpr int kTargets = 4000;
  double sum = 0.0;
  double without = 0.0;
  for (int i = 0; i < kTargets; ++i) {
    RoomOfDots built = room_;
    for (core::TargetDot& dot : built.rig.target.dots) {
      dot.position_m += Vector3d(normal(room_.random), normal(room_.random), normal(room_.random));
    }
    const geometry::RigidMotion truth = room_.somewhere();
    ASSERT_EQ(fit(built.see(truth, kSigma_px), room_.near(truth)), PoseFitStatus::ok);
    sum += test::nees(fit_.pose, truth);
    core::Pose forgetful = fit_.pose;
    forgetful.covariance -= fit_.systematic;
    without += test::nees(forgetful, truth);
    room_.random.discard(7);
  }
  EXPECT_NEAR(sum / kTargets, 6.0, 4.0 * std::sqrt(12.0 / kTargets));
  EXPECT_GT(without / kTargets, 12.0);
}

}  // namespace
}  // namespace dottrack::estimation
