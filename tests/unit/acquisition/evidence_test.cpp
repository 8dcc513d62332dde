#include "app/core/acquisition/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "app/core/acquisition/clutter.h"
#include "tests/unit/acquisition/finalist_scenes.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLimit_m = 0.02;

// ---- The probability from the odds

TEST(FalseLockProbability, IsTheShareOfEverythingElse) {
  EXPECT_NEAR(false_lock_probability(0.0, {}), 0.5, 1e-6);
  EXPECT_NEAR(false_lock_probability(std::log(3.0), {}), 0.25, 1e-6);
  const std::array<double, 2> rivals = {std::log(2.0), std::log(4.0)};
  EXPECT_NEAR(false_lock_probability(std::log(3.0), rivals), 0.7, 1e-6);
}

TEST(FalseLockProbability, IsAHalfBesideAnEqualRival) {
  for (const double odds : {30.0, 700.0, 1e4}) {
    EXPECT_NEAR(false_lock_probability(odds, {&odds, 1}), 0.5, 1e-6);
  }
}

TEST(FalseLockProbability, OverflowsForNoOdds) {
  const double sure = 1e4;
  const double never = -1e4;
  EXPECT_EQ(false_lock_probability(sure, {}), 0.0);
  EXPECT_EQ(false_lock_probability(never, {}), 1.0);
  EXPECT_EQ(false_lock_probability(sure, {&never, 1}), 0.0);
  EXPECT_EQ(false_lock_probability(never, {&sure, 1}), 1.0);
  const double nothing = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(false_lock_probability(nothing, {&nothing, 1}), 1.0);
}

TEST(FalseLockProbability, BelievesNothingThatIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(false_lock_probability(none, {}), 1.0);
  EXPECT_EQ(false_lock_probability(std::numeric_limits<double>::infinity(), {}), 1.0);
  EXPECT_EQ(false_lock_probability(0.0, {&none, 1}), 1.0);
}

// ---- How well places fit

RigidDots corners(const Vector3d& error_of_last_m, double sigma_m) {
  RigidDots dots;
  for (const Vector3d& arm : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.5, 0.0, 0.0),
                              Vector3d(0.0, 0.4, 0.0), Vector3d(0.3, 0.3, 0.2)}) {
    dots.push_back({arm, Vector3d::Zero(), sigma_m * sigma_m * Matrix3d::Identity()});
  }
  dots.back().error_m = error_of_last_m;
  return dots;
}

// The residual's density times how poses and residuals span the places, worked out for dots that
// are all known equally well and fit exactly.
TEST(RigidFit, IsTheResidualsDensityOverTheSpanOfThePoses) {
  const double limit_m = 1e-6;  // systematic errors next to none
  const double sigma_m = 0.003;
  const RigidDots dots = corners(Vector3d::Zero(), sigma_m);
  Vector3d mean = Vector3d::Zero();
  for (const RigidDot& d : dots) mean += d.arm_m / 4.0;
  Matrix3d inertia = Matrix3d::Zero();
  for (const RigidDot& d : dots) {
    const Vector3d r = d.arm_m - mean;
    inertia += r.squaredNorm() * Matrix3d::Identity() - r * r.transpose();
  }
  const double span = std::pow(4.0, 1.5) * std::sqrt(inertia.determinant());
  const double density = std::pow(2.0 * std::numbers::pi * sigma_m * sigma_m, -3.0);
  EXPECT_NEAR(log_fit(as_span(dots), limit_m), std::log(density / span), 1e-4);
}

TEST(RigidFit, DoesNotDependOnThePoseItIsTakenFrom) {
  const RigidDots dots = corners({0.004, -0.003, 0.005}, 0.002);
  RigidDots moved = dots;
  const Vector3d turn(1e-3, -2e-3, 1.5e-3);
  for (RigidDot& d : moved) d.error_m += Vector3d(0.002, 0.001, -0.003) + turn.cross(d.arm_m);
  EXPECT_NEAR(log_fit(as_span(dots), kLimit_m), log_fit(as_span(moved), kLimit_m), 1e-9);
}

TEST(RigidFit, FallsWithTheResidualAndNeverGainsBeyondTheSystematicErrors) {
  double before = std::numeric_limits<double>::infinity();
  for (const double off_m : {0.0, 0.004, 0.008, 0.016, 0.032}) {
    const double fit = log_fit(as_span(corners({off_m, 0.0, off_m}, 0.002)), kLimit_m);
    EXPECT_LT(fit, before);
    before = fit;
  }
  const double sharp = log_fit(as_span(corners(Vector3d::Zero(), 1e-5)), kLimit_m);
  const double sharpest = log_fit(as_span(corners(Vector3d::Zero(), 1e-9)), kLimit_m);
  EXPECT_NEAR(sharp, sharpest, 0.02);
}

TEST(RigidFit, WithoutADotIsThatOfTheOthers) {
  RigidDots dots = corners({0.004, -0.003, 0.005}, 0.002);
  dots.push_back({{-0.2, 0.1, 0.3}, {0.001, 0.002, -0.004}, 1e-5 * Matrix3d::Identity()});
  dots.back().covariance_m2(0, 1) = dots.back().covariance_m2(1, 0) = 4e-6;
  const RigidFit fit(as_span(dots), kLimit_m);
  EXPECT_EQ(fit.log_density(), log_fit(as_span(dots), kLimit_m));
  for (std::size_t i = 0; i < dots.size(); ++i) {
    RigidDots others = dots;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NEAR(fit.log_density_without(i), log_fit(as_span(others), kLimit_m), 1e-9);
  }
}

TEST(RigidFit, FindsTheMotionOfAllDotsButOne) {
  RigidDots dots = corners(Vector3d::Zero(), 0.002);
  const Vector3d shift(0.002, 0.001, -0.003);
  const Vector3d turn(1e-3, -2e-3, 1.5e-3);
  for (RigidDot& d : dots) d.error_m = shift + turn.cross(d.arm_m);
  dots[1].error_m += Vector3d(0.5, -0.2, 0.1);
  RigidStep step;
  ASSERT_TRUE(RigidFit(as_span(dots), kLimit_m).best_step_without(1, step));
  for (const Vector3d& place : {Vector3d(0.0, 0.0, 0.0), Vector3d(1.0, -2.0, 0.5)}) {
    EXPECT_LT((step.of(place) - shift - turn.cross(place)).norm(), 1e-12);
  }
}

TEST(RigidFit, OfAPairIsThatItsLengthFits) {
  const RigidDot a{{0.1, 0.0, 0.0}, {0.0, 0.0, 0.0}, 4e-6 * Matrix3d::Identity()};
  RigidDot b{{0.4, 0.0, 0.0}, {0.0, 0.0, 0.0}, 4e-6 * Matrix3d::Identity()};
  const double sigma_m = std::sqrt(8e-6);
  const double expected =
      std::log(std::sqrt(2.0 * std::numbers::pi) / sigma_m / (0.3 * 0.3));  // 2 pi N(0) / e^2
  EXPECT_NEAR(log_pair_fit(a, b, 1e-6), expected, 1e-4);
  b.error_m.x() = sigma_m;
  EXPECT_NEAR(log_pair_fit(a, b, 1e-6), expected - 0.5, 1e-4);
  EXPECT_EQ(log_fit(std::array{a, b}, kLimit_m), -std::numeric_limits<double>::infinity());
}

// ---- Clutter

// Clutter in the room, seen by three cameras or by five, and one witness in its middle.
class ClutterDensity : public testing::Test {
 protected:
  void add(const Vector3d& place_m, int views) {
    finalists_.push_back(make_.seen(place_m, views, 0.1, 1e-9));
  }
  double density(int views, const Vector3d& at_m = Vector3d::Zero()) {
    const Witness witness{0, at_m, Matrix3d::Identity(), 0.1, views};
    return Clutter(make_.target(3), {&witness, 1}, finalists_).density_per_m3(0);
  }
  // The mean over many rooms of an estimate's logarithm, as a factor.
  template <class Fill>
  double typical(int views, const Fill& fill) {
    constexpr int kRooms = 200;
    double sum = 0.0;
    for (int i = 0; i < kRooms; ++i) {
      finalists_.clear();
      for (const double side : {-0.5, 0.5}) add(side * test::kRoom_m, 2);
      fill();
      sum += std::log(density(views));
    }
    return std::exp(sum / kRooms);
  }

  test::SceneMaker make_{7};
  std::vector<Finalist> finalists_;
};

TEST_F(ClutterDensity, IsTheRooms) {
  const double found = typical(3, [&] {
    for (int i = 0; i < 300; ++i) add(make_.in_room(), 3);
  });
  EXPECT_GT(found, 0.7 * 300.0 / test::kRoom_m.prod());
  EXPECT_LT(found, 2.0 * 300.0 / test::kRoom_m.prod());
}

TEST_F(ClutterDensity, CountsOnlyWhatIsSeenByAsMany) {
  const double found = typical(5, [&] {
    for (int i = 0; i < 300; ++i) add(make_.in_room(), i < 60 ? 5 : 3);
  });
  EXPECT_GT(found, 0.7 * 60.0 / test::kRoom_m.prod());
  EXPECT_LT(found, 2.5 * 60.0 / test::kRoom_m.prod());
}

TEST_F(ClutterDensity, IsThatOfACrowd) {
  const double found = typical(3, [&] {
    for (int i = 0; i < 30; ++i) add(make_.in_box({0.5, 0.5, 0.5}), 3);
  });
  EXPECT_GT(found, 0.6 * 30.0);
  EXPECT_LT(found, 2.5 * 30.0);
}

TEST_F(ClutterDensity, IsThatOfAFloorOnTheFloorAndLessAboveIt) {
  const auto floor = [&] {
    for (int i = 0; i < 100; ++i) {
      Vector3d p = make_.in_room();
      p.z() = make_.uniform(-0.01, 0.01);
      add(p, 3);
    }
  };
  const double over_floor = 100.0 / (test::kRoom_m.x() * test::kRoom_m.y());
  EXPECT_GT(typical(3, floor), 0.5 * over_floor / 0.03);
  EXPECT_LT(density(3, {0.0, 0.0, 0.5}), 2.0 * over_floor);
}

TEST_F(ClutterDensity, IsNeverNothing) {
  EXPECT_GT(density(2), 0.0);
  finalists_.clear();
  EXPECT_LE(density(2), 0.5);
}

TEST_F(ClutterDensity, LeavesSplintersOut) {
  add({0.0, 0.0, 0.0}, 4);
  const Finalist own = finalists_.front();
  for (const double x : {-3.0, 3.0}) add({x, x, 0.8}, 4);
  const Witness witness{0, own.position_m, own.covariance_m2, 0.1, 4, 0};
  const auto estimate = [&] {
    return Clutter(make_.target(3), {&witness, 1}, finalists_).density_per_m3(0);
  };
  const double alone = estimate();
  add({0.05, 0.0, 0.0}, 4);  // within the dot
  Finalist splinter = own;
  splinter.position_m.x() = 0.4;  // of the same sightings
  finalists_.push_back(splinter);
  EXPECT_EQ(estimate(), alone);
  add({0.4, 0.0, 0.0}, 4);
  EXPECT_GT(estimate(), alone);
}

// ---- The odds of one tick

// The target's dots without an error, and a little clutter around.
class LogOdds : public testing::Test {
 protected:
  LogOdds() {
    scene_.target.upright = true;
    for (const Vector3d& p : {Vector3d(0.2, 0.1, 0.0), Vector3d(-0.3, 0.15, 0.05),
                              Vector3d(0.05, -0.25, 0.1), Vector3d(-0.1, 0.05, 0.2)}) {
      scene_.target.dots.push_back({p, 0.1, {}});
    }
    place(scene_.target.dots.size());
    scene_.noise_m = 0.002;
    make_.add_clutter(scene_, test::ClutterKind::everywhere, 80);
  }
  void place(std::size_t dots) {
    for (std::size_t i = 0; i < dots; ++i) {
      scene_.finalists.push_back(
          make_.seen(pose_.position_m + scene_.target.dots[i].position_m, 4, 0.1, 1e-9));
      scene_.finalists.back().covariance_m2 = 4e-6 * Matrix3d::Identity();
    }
  }
  // Of the first so many dots of the target.
  double log_odds(std::size_t dots = 4) {
    Selection selection;
    selection.assignment.fill(kNoCandidate);
    for (std::uint16_t i = 0; i < dots; ++i) selection.assignment[i] = i;
    selection.dots = static_cast<std::uint8_t>(dots);
    const Witnesses witnesses = witnesses_of(scene_.finalists, selection);
    EXPECT_EQ(witnesses.size(), dots);
    return log_odds_of(scene_.target, as_span(witnesses), pose_, scene_.finalists, kLimit_m);
  }

  test::SceneMaker make_{3};
  test::FinalistScene scene_;
  core::Pose pose_{Vector3d(1.0, -1.0, 0.2)};
};

TEST_F(LogOdds, GrowWithTheDots) {
  const double four = log_odds(4);
  scene_.target.dots.pop_back();
  const double three = log_odds(3);
  EXPECT_GT(four, three + 5.0);
  EXPECT_GT(three, 0.0);
}

TEST_F(LogOdds, FallWhenADotIsLeftOut) {
  scene_.target.dots.push_back({{0.3, -0.2, 0.1}, 0.1, {}});
  const double one_left_out = log_odds(4);
  scene_.target.dots.pop_back();
  EXPECT_NEAR(log_odds(4) - one_left_out, std::log(5.0), 1e-9);
}

TEST_F(LogOdds, GrowWithTheViews) {
  for (std::size_t i = 0; i < 4; ++i) scene_.finalists[i].cameras = CameraSet::first(2);
  const double two = log_odds();
  for (std::size_t i = 0; i < 4; ++i) scene_.finalists[i].cameras = CameraSet::first(6);
  EXPECT_GT(log_odds(), two + 2.0);
}

TEST_F(LogOdds, FallWithTheResidual) {
  const double exact = log_odds();
  scene_.finalists[0].position_m += Vector3d(0.0, 0.0, 0.02);
  EXPECT_LT(log_odds(), exact - 3.0);
}

TEST_F(LogOdds, FallWithAWrongSizeButForgiveABiasInCommon) {
  const double exact = log_odds();
  scene_.finalists[0].diameter_m = 0.14;
  const double one = log_odds();
  for (std::size_t i = 0; i < 4; ++i) scene_.finalists[i].diameter_m = 0.11;
  const double all = log_odds();
  EXPECT_LT(one, exact - 2.0);
  EXPECT_GT(all, exact - 2.0);
}

TEST_F(LogOdds, FallWithClutterAround) {
  const double before = log_odds();
  for (int i = 0; i < 50; ++i) {
    scene_.finalists.push_back(
        make_.seen(pose_.position_m + make_.in_box({0.6, 0.6, 0.6}), 4, 0.1, 0.002));
  }
  EXPECT_LT(log_odds(), before - 4.0);
}

TEST_F(LogOdds, OfFewerThanThreeDotsAreNone) {
  EXPECT_EQ(log_odds(2), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace dottrack::acquisition
