#include "app/core/estimation/pose_information.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "tests/unit/estimation/motion_drive.h"

namespace dottrack::estimation {
namespace {

Matrix12d some_covariance(Random& random) {
  std::normal_distribution<double> normal;
  const Matrix12d root = Matrix12d::NullaryExpr([&] { return 0.001 * normal(random); });
  return root * root.transpose() + 1e-8 * Matrix12d::Identity();
}

MotionState some_state(Random& random) {
  MotionState state;
  Vector12d step;
  step << normal_vector(random, 1.0), normal_vector(random, 1.0), normal_vector(random, 1.0),
      normal_vector(random, 1.0);
  move_by(step, state);
  state.covariance = some_covariance(random);
  return state;
}

Truth truth_near(const MotionState& state, Random& random) {
  Vector12d step = Vector12d::Zero();
  step.head<6>() << normal_vector(random, 1e-3), normal_vector(random, 1e-3);
  MotionState there = state;
  move_by(step, there);
  return {there.position_m, there.orientation, there.velocity_m_s, there.rates_rad_s};
}

TEST(PoseInformation, MovesTheStateAsAKalmanFilterDoes) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const MotionState before = some_state(random);
    const PoseInformation views = look(truth_near(before, random), Time{}, 8, 0.001, random);
    MotionState after = before;
    take_in(views, after);
    // Textbook: K = P H' (H P H' + R)^-1 with a measurement of the whole pose.
    const Matrix6d r = views.information.inverse();
    const Eigen::Matrix<double, 12, 6> ph = before.covariance.leftCols<6>();
    const Eigen::Matrix<double, 12, 6> k =
        ph * (before.covariance.topLeftCorner<6, 6>() + r).inverse();
    const Vector12d step = k * (r * gradient_at(before, views));
    const Matrix12d covariance = before.covariance - k * ph.transpose();
    ASSERT_LT((difference(after, before) - step).norm(), 1e-6 * step.norm() + 1e-12);
    ASSERT_LT((after.covariance - covariance).norm(), 1e-6 * covariance.norm());
  }
}

TEST(PoseInformation, WeighsStatesByHowProbableTheyMakeTheViews) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    MotionState a = some_state(random);
    MotionState b = a;
    b.covariance = some_covariance(random);
    Vector12d apart = Vector12d::Zero();
    apart.head<3>() = normal_vector(random, 1e-3);
    move_by(apart, b);
    const PoseInformation views = look(truth_near(a, random), Time{}, 8, 0.001, random);
    const auto log_density = [&](const MotionState& state) {
      const Matrix6d r = views.information.inverse();
      const Matrix6d s = state.covariance.topLeftCorner<6, 6>() + r;
      const Vector6d innovation = r * gradient_at(state, views);
      return -0.5 * (innovation.dot(s.inverse() * innovation) + std::log(s.determinant()));
    };
    const double expected = log_density(a) - log_density(b);
    ASSERT_NEAR(take_in(views, a) - take_in(views, b), expected, 1e-5 * (1.0 + std::abs(expected)));
  }
}

TEST(PoseInformation, TakenInTogetherOrOneAfterAnotherIsTheSame) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    MotionState one_by_one = some_state(random);
    MotionState together = one_by_one;
    const Truth truth = truth_near(together, random);
    PoseInformation sum = look(truth, Time{}, 3, 0.001, random);
    double log_likelihood = take_in(sum, one_by_one);
    const PoseInformation other = look(truth, Time{}, 2, 0.001, random);
    log_likelihood += take_in(other, one_by_one);
    add(other, sum);
    EXPECT_EQ(sum.coordinates, 5);
    take_in(sum, together);
    // The rotation steps of a few milliradians do not commute: to the second order.
    ASSERT_LT(difference(together, one_by_one).head<6>().norm(), 2e-5);
    ASSERT_LT((together.covariance - one_by_one.covariance).norm(),
              1e-6 * together.covariance.norm());
    ASSERT_TRUE(std::isfinite(log_likelihood));
  }
}

TEST(PoseInformation, SaysNothingWhereItSeesNothing) {
  Random random(4);
  MotionState state = some_state(random);
  const MotionState before = state;
  PoseInformation nothing;
  nothing.position_m = state.position_m;
  nothing.orientation = state.orientation;
  EXPECT_NEAR(take_in(nothing, state), 0.0, 1e-12);
  EXPECT_LT((state.covariance - before.covariance).norm(), 1e-12 * before.covariance.norm());
  EXPECT_EQ(surprise(nothing.information, nothing.gradient, Matrix6d::Identity()), 0.0);
}

// Views of a pose drawn from the state's own covariance: chi-square with as many degrees of freedom
// as coordinates, as long as these are fewer than six.
TEST(PoseInformation, SurprisesAsChiSquareDoes) {
  Random random(5);
  std::normal_distribution<double> normal;
  for (const int coordinates : {1, 3, 6, 12}) {
    const int freedom = std::min(coordinates, 6);
    double sum = 0.0;
    int beyond = 0;
    constexpr int kDraws = 20'000;
    const Matrix6d covariance = 1e-4 * Matrix6d::Identity();
    for (int i = 0; i < kDraws; ++i) {
      MotionState state;
      Vector12d step = Vector12d::Zero();
      for (int j = 0; j < 6; ++j) step[j] = 0.01 * normal(random);
      MotionState there;
      move_by(step, there);
      const Truth truth{there.position_m, there.orientation, {}, {}};
      const PoseInformation views = look(truth, Time{}, coordinates, 0.001, random);
      const double s = surprise(views.information, gradient_at(state, views), covariance);
      sum += s;
      beyond += s > largest_surprise(coordinates) ? 1 : 0;
    }
    EXPECT_NEAR(sum / kDraws, freedom, 0.03 * freedom) << coordinates;
    EXPECT_LE(beyond, 2) << coordinates;
  }
}

}  // namespace
}  // namespace dottrack::estimation
