// How far the dots are off their places, as the views of single poses show it, and what poses make
// of it.

#include "app/core/estimation/dot_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/estimation/pose_fit.h"
#include "tests/unit/estimation/room_of_dots.h"

namespace dottrack::estimation {
namespace {

using test::RoomOfDots;
using test::Vector3d;

constexpr double kSigma_px = 0.03;
constexpr double kOff_m = 0.0004;

class DotSpreadTest : public testing::Test {
 protected:
  void put_dots_off(RoomOfDots& built, double sigma_m) {
    std::normal_distribution<double> normal(0.0, sigma_m);
    for (core::TargetDot& dot : built.rig.target.dots) {
      dot.position_m += Vector3d(normal(room_.random), normal(room_.random), normal(room_.random));
    }
  }

  PoseFitStatus fit(const DotObservations& views, const geometry::RigidMotion& truth,
                    const DotSpread& spread) {
    PoseFitter fitter(room_.rig);
    return fitter.fit(as_span(views), {}, room_.near(truth), spread, fit_);
  }

  struct Mean {
    double variance_m2 = 0.0;
    double sigma_m2 = 0.0;  // of the mean
  };

  // Of the evidence of many targets that are off by so much, seen by `cameras`.
  template <class MakeCameras>
  Mean mean_evidence(double off_m, MakeCameras cameras) {
    constexpr int kTargets = 3000;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kTargets; ++i) {
      RoomOfDots built = room_;
      put_dots_off(built, off_m);
      const geometry::RigidMotion truth = room_.somewhere();
      const std::vector<core::Camera> seeing = cameras();
      EXPECT_EQ(fit(built.see(truth, kSigma_px, seeing), truth, DotSpread::none()),
                PoseFitStatus::ok);
      const double variance = fit_.spread.variance_m2();
      sum += variance;
      squares += variance * variance;
      room_.random.discard(7);
    }
    const double mean = sum / kTargets;
    return {mean, std::sqrt((squares / kTargets - mean * mean) / kTargets)};
  }
  Mean mean_evidence(double off_m) {
    const std::vector<core::Camera> cameras(room_.rig.cameras.begin(), room_.rig.cameras.end());
    return mean_evidence(off_m, [&] { return cameras; });
  }

  RoomOfDots room_;
  PoseFit fit_;
};

TEST_F(DotSpreadTest, TheMeanIsTheTruth) {
  for (const double off_m : {0.0, 0.0001, kOff_m}) {
    const Mean mean = mean_evidence(off_m);
    EXPECT_NEAR(mean.variance_m2, off_m * off_m, 4.0 * mean.sigma_m2) << off_m;
    EXPECT_LT(mean.sigma_m2, 1e-9 + 0.02 * off_m * off_m) << off_m;
  }
}

TEST_F(DotSpreadTest, WhateverWasAssumed) {
  room_.rig.target.dot_sigma_m = 2.0 * kOff_m;
  const Mean mean = mean_evidence(kOff_m);
  EXPECT_NEAR(mean.variance_m2, kOff_m * kOff_m, 4.0 * mean.sigma_m2);
  EXPECT_LT(mean.sigma_m2, 0.03 * kOff_m * kOff_m);
}

// Models that are wrong shift all dots of a camera: that is not taken for the dots' doing.
TEST_F(DotSpreadTest, WhateverTheModelsAre) {
  const test::WrongModels wrong{.shift_m = 0.0008, .turn_px = 0.15};
  const std::vector<core::Camera> said = acquisition::test::ceiling_cameras();
  wrong.tell(room_.rig);
  const auto cameras = [&] { return wrong.draw(said, room_.random); };
  for (const double off_m : {0.0, kOff_m}) {
    const Mean mean = mean_evidence(off_m, cameras);
    EXPECT_NEAR(mean.variance_m2, off_m * off_m, 4.0 * mean.sigma_m2) << off_m;
    EXPECT_LT(mean.sigma_m2, 0.1 * kOff_m * kOff_m) << off_m;
  }
}

// The target's file knows nothing of it; from some ticks before, the covariance does.
TEST_F(DotSpreadTest, MakesTheCovarianceTrue) {
  constexpr int kTargets = 1000;
  constexpr int kTicks = 12;
  double learnt = 0.0;
  double unlearnt = 0.0;
  double first = 0.0;
  for (int i = 0; i < kTargets; ++i) {
    DotSpread spread;
    geometry::RigidMotion truth;
    DotObservations views;
    for (int tick = 0; tick < kTicks; ++tick) {
      RoomOfDots built = room_;
      put_dots_off(built, kOff_m);
      truth = room_.somewhere();
      views = built.see(truth, kSigma_px);
      ASSERT_EQ(fit(views, truth, spread), PoseFitStatus::ok);
      if (tick == 0) first += test::nees(fit_.pose, truth);
      spread.take_in(fit_.spread);
      room_.random.discard(7);
    }
    learnt += test::nees(fit_.pose, truth);
    ASSERT_EQ(fit(views, truth, DotSpread::none()), PoseFitStatus::ok);
    unlearnt += test::nees(fit_.pose, truth);
  }
  EXPECT_NEAR(learnt / kTargets, 6.0, 0.5);
  EXPECT_LT(first / kTargets, 9.5);
  EXPECT_GT(unlearnt / kTargets, 18.0);
}

// Dots in their places are hardly ever thought to be off, and poses hardly ever less sure for it.
TEST_F(DotSpreadTest, LeavesTargetsAloneThatAreAsTheySay) {
  constexpr int kTicks = 3000;
  DotSpread spread;
  double sum = 0.0;
  double squared_sigma_m2 = 0.0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const geometry::RigidMotion truth = room_.somewhere();
    ASSERT_EQ(fit(room_.see(truth, kSigma_px), truth, spread), PoseFitStatus::ok);
    spread.take_in(fit_.spread);
    sum += test::nees(fit_.pose, truth);
    squared_sigma_m2 += fit_.dot_sigma_m * fit_.dot_sigma_m;
  }
  EXPECT_GT(sum / kTicks, 5.5);
  EXPECT_LT(sum / kTicks, 6.1);
  EXPECT_LT(std::sqrt(squared_sigma_m2 / kTicks), 0.00006);
}

TEST_F(DotSpreadTest, ForgetsWhatIsOld) {
  DotSpread spread;
  spread.take_in({4.0, 1e6});
  EXPECT_DOUBLE_EQ(spread.variance_m2(), 4e-6);
  for (int tick = 0; tick < 22; ++tick) spread.take_in({0.0, 1e6});
  EXPECT_LT(spread.variance_m2(), 0.05 * 4e-6);
  spread.take_in({-100.0, 1e6});
  EXPECT_EQ(spread.variance_m2(), 0.0);
}

// Six coordinates are a pose, and nothing is left over.
TEST_F(DotSpreadTest, IsNotSeenInThreeViews) {
  constexpr int kPoses = 200;
  int poses = 0;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views = room_.see(truth, kSigma_px, {room_.rig.cameras.data(), 1});
    views.resize(3);
    if (fit(views, truth, DotSpread{}) != PoseFitStatus::ok) continue;
    ++poses;
    EXPECT_EQ(fit_.spread.weight, 0.0) << i;
    EXPECT_EQ(fit_.dot_sigma_m, 0.0) << i;
  }
  EXPECT_GT(poses, 0.9 * kPoses);
}

// The rig file's figure stands where the views show less.
TEST_F(DotSpreadTest, IsNeverBelowWhatIsKnown) {
  room_.rig.target.dot_sigma_m = kOff_m;
  const geometry::RigidMotion truth = room_.somewhere();
  ASSERT_EQ(fit(room_.see(truth, kSigma_px), truth, DotSpread{}), PoseFitStatus::ok);
  EXPECT_DOUBLE_EQ(fit_.dot_sigma_m, kOff_m);
}

}  // namespace
}  // namespace dottrack::estimation
