#include "app/core/estimation/motion_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "app/core/estimation/rotation.h"
#include "tests/unit/estimation/motion_drive.h"

namespace dottrack::estimation {
namespace {

using Eigen::Vector3d;

const core::MotionLimits kLimits;

MotionState moving_state(Random& random) {
  MotionState state;
  Vector12d step;
  step << normal_vector(random, 1.0), normal_vector(random, 1.0), normal_vector(random, 1.0),
      normal_vector(random, 2.0);
  move_by(step, state);
  return state;
}

TEST(Rotation, VectorsAndTurnsAreEachOthersInverse) {
  Random random(1);
  for (const double size : {1e-9, 1e-5, 1e-4, 0.1, 1.0, 3.0}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3d v = size * normal_vector(random, 1.0).normalized();
      ASSERT_NEAR(turn_by(v).norm(), 1.0, 1e-14);
      ASSERT_LT((rotation_vector(turn_by(v)) - v).norm(), 1e-13 * (1.0 + size));
    }
  }
}

TEST(Rotation, LeftJacobianIsTheDerivative) {
  Random random(2);
  constexpr double kStep = 1e-6;
  for (const double size : {1e-6, 5e-5, 2e-4, 0.3, 2.0}) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d v = size * normal_vector(random, 1.0).normalized();
      const Vector3d d = normal_vector(random, 1.0).normalized();
      const Vector3d numeric =
          rotation_vector(turn_by(v + kStep * d) * turn_by(v - kStep * d).conjugate()) /
          (2.0 * kStep);
      ASSERT_LT((left_jacobian(v) * d - numeric).norm(), 1e-8);
    }
  }
}

TEST(MotionState, DifferencesAndStepsAreEachOthersInverse) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const MotionState a = moving_state(random);
    const MotionState b = moving_state(random);
    MotionState moved = b;
    move_by(difference(a, b), moved);
    ASSERT_LT(difference(moved, a).norm(), 1e-12);
  }
}

TEST(MotionModel, ProbabilitiesOfWhatComesNextSumToOne) {
  for (const double seconds : {0.001, 0.01, 0.1, 1.0}) {
    for (const auto& row : switching(seconds)) {
      EXPECT_NEAR(std::accumulate(row.begin(), row.end(), 0.0), 1.0, 1e-12);
      for (const double p : row) EXPECT_GE(p, 0.0);
    }
  }
}

TEST(MotionModel, RestEndsAllMotionAndKeepsThePlace) {
  Random random(4);
  MotionState state = moving_state(random);
  state.covariance = Matrix12d::Identity();
  const Vector3d place = state.position_m;
  advance(MotionModel::at_rest, kLimits, 4.0, state);
  EXPECT_EQ(state.position_m, place);
  EXPECT_EQ(state.velocity_m_s, Vector3d::Zero());
  EXPECT_EQ(state.rates_rad_s, Vector3d::Zero());
  EXPECT_NEAR(state.covariance(0, 0), 1.0 + 4.0 * kTremor_m * kTremor_m, 1e-14);
  EXPECT_NEAR(state.covariance(6, 6), kRestSpeed_m_s * kRestSpeed_m_s, 1e-20);
}

// The covariance's way through time against numeric derivatives of the state's.
TEST(MotionModel, CarriesTheCovarianceAsTheMotionCarriesErrors) {
  Random random(5);
  constexpr double kStep = 1e-6;
  constexpr double kSeconds = 0.1;
  for (int i = 0; i < 50; ++i) {
    MotionState state = moving_state(random);
    MotionState later = state;
    advance(MotionModel::steady, kLimits, kSeconds, later);
    Matrix12d f;
    for (int column = 0; column < 12; ++column) {
      MotionState shifted = state;
      move_by(kStep * Vector12d::Unit(column), shifted);
      advance(MotionModel::steady, kLimits, kSeconds, shifted);
      f.col(column) = difference(shifted, later) / kStep;
    }
    const Matrix12d noise = later.covariance;  // the state's own was zero
    state.covariance = Matrix12d::Identity();
    advance(MotionModel::steady, kLimits, kSeconds, state);
    const Matrix12d expected = f * f.transpose() + noise;
    ASSERT_LT((state.covariance - expected).norm(), 1e-5);
  }
}

TEST(MotionModel, NoiseOverManyStepsIsThatOfOne) {
  Random random(6);
  MotionState once = moving_state(random);
  once.rates_rad_s.setZero();
  MotionState often = once;
  advance(MotionModel::driven, kLimits, 0.5, once);
  for (int i = 0; i < 50; ++i) advance(MotionModel::driven, kLimits, 0.01, often);
  EXPECT_LT((once.covariance - often.covariance).norm(), 1e-9 * once.covariance.norm());
  EXPECT_LT(difference(once, often).norm(), 1e-12);
}

TEST(MotionModel, GoesBackToWhereItCameFrom) {
  Random random(7);
  const MotionState before = moving_state(random);
  MotionState state = before;
  advance(MotionModel::steady, kLimits, 0.05, state);
  advance(MotionModel::steady, kLimits, -0.05, state);
  EXPECT_LT(difference(state, before).norm(), 1e-12);
  EXPECT_GT(state.covariance.diagonal().minCoeff(), 0.0);
}

}  // namespace
}  // namespace dottrack::estimation
