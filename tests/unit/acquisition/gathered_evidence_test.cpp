#include "app/core/acquisition/gathered_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dottrack::acquisition {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSigma_m = 0.002;

class Gathering : public testing::Test {
 protected:
  Gathering() {
    for (const Vector3d& p :
         {Vector3d(0.2, 0.1, 0.0), Vector3d(-0.3, 0.15, 0.05), Vector3d(0.05, -0.25, 0.1)}) {
      target_.dots.push_back({p, 0.1, {}});
    }
  }

  // The target's dots found at this pose, the first one off by an error.
  CandidateLock at(const Vector3d& place_m, double yaw_rad = 0.0,
                   const Vector3d& error_m = Vector3d::Zero()) const {
    CandidateLock lock;
    lock.pose.position_m = place_m;
    lock.pose.orientation = Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
    for (std::size_t i = 0; i < target_.dots.size(); ++i) {
      lock.witnesses.push_back({i, place_m + lock.pose.orientation * target_.dots[i].position_m,
                                kSigma_m * kSigma_m * Matrix3d::Identity(), 0.1, 4});
    }
    lock.witnesses.front().position_m += error_m;
    lock.log_odds = 8.0;
    return lock;
  }
  double add(const CandidateLock& lock) { return gathered_.add(lock, now_ += Duration(1)); }
  double stand(int ticks, const Vector3d& error_m = Vector3d::Zero()) {
    double p = 1.0;
    for (int i = 0; i < ticks; ++i) p = add(at(Vector3d::Zero(), 0.0, error_m));
    return p;
  }

  core::Target target_;
  core::TrackingLimits limits_;
  GatheredEvidence gathered_{target_, limits_};
  Time now_{};
};

TEST_F(Gathering, OfOneTickIsThatTicks) {
  EXPECT_NEAR(add(at(Vector3d::Zero())), false_lock_probability(8.0, {}), 1e-9);
  EXPECT_EQ(gathered_.ticks(), 1);
  EXPECT_EQ(gathered_.places(), 1);
}

TEST_F(Gathering, OfAPerfectFitGrowsByAveragingUpToTheSystematicErrors) {
  const double one = stand(1);
  const double ten = stand(9);
  const double thousand = stand(990);
  const double two_thousand = stand(1000);
  EXPECT_LT(ten, one / 5.0);
  EXPECT_GT(ten, one / std::pow(10.0, 1.5));
  EXPECT_LT(thousand, ten);
  EXPECT_GT(thousand, ten / 200.0);
  EXPECT_GT(two_thousand, 0.7 * thousand);
  EXPECT_EQ(gathered_.places(), 1);
}

TEST_F(Gathering, FindsOutAFitThatIsOnlyNearlyOne) {
  const Vector3d off_m(0.006, 0.0, 0.0);
  const double one = stand(1, off_m);
  EXPECT_GT(stand(99, off_m), 0.1 * one);
}

TEST_F(Gathering, GainsFromEveryPlaceThatItMovesTo) {
  double before = add(at(Vector3d::Zero()));
  for (int i = 1; i <= 3; ++i) {
    const double after = add(at({0.1 * i, 0.0, 0.0}));
    EXPECT_LT(after, before / 1e3);
    EXPECT_GT(after, before / 1e6);
    before = after;
  }
  EXPECT_EQ(gathered_.places(), 4);
}

TEST_F(Gathering, GainsNothingFromAMoveThatMayBeNoise) {
  add(at(Vector3d::Zero()));
  add(at({0.02, 0.0, 0.0}));
  EXPECT_EQ(gathered_.places(), 1);
}

TEST_F(Gathering, GainsFromEachPlaceOnce) {
  for (int i = 0; i < 10; ++i) add(at({i % 2 == 0 ? 0.0 : 0.1, 0.0, 0.0}));
  EXPECT_EQ(gathered_.places(), 2);
}

TEST_F(Gathering, GainsFromATurnUnlessADotStays) {
  add(at(Vector3d::Zero()));
  add(at(Vector3d::Zero(), 0.4));
  EXPECT_EQ(gathered_.places(), 2);
  gathered_.forget();
  add(at(Vector3d::Zero()));
  const Vector3d& fixed = target_.dots[0].position_m;
  add(at(fixed - Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * fixed, 0.3));
  EXPECT_EQ(gathered_.ticks(), 2);
  EXPECT_EQ(gathered_.places(), 1);
}

// Where clutter is so dense that the vehicle's reach is full of matches, moving proves nothing.
TEST_F(Gathering, GainsNothingFromAMoveThatChanceWouldOffer) {
  CandidateLock lock = at(Vector3d::Zero());
  lock.log_odds = -30.0;
  const double before = add(lock);
  lock = at({0.1, 0.0, 0.0});
  lock.log_odds = -30.0;
  add(lock);
  EXPECT_EQ(gathered_.places(), 2);
  EXPECT_GE(before, 0.999);
  EXPECT_GE(add(lock), 0.999);
}

TEST_F(Gathering, BeginsAnewAfterAJump) {
  stand(10);
  add(at({0.3, 0.0, 0.0}));
  EXPECT_EQ(gathered_.ticks(), 1);
}

TEST_F(Gathering, BeginsAnewWithOtherDots) {
  target_.dots.push_back({{0.1, 0.1, 0.3}, 0.1, {}});
  target_.dots.push_back({{-0.1, 0.2, 0.3}, 0.1, {}});
  CandidateLock lock = at(Vector3d::Zero());
  lock.witnesses.pop_back();
  add(lock);
  add(lock);
  EXPECT_EQ(gathered_.ticks(), 2);
  lock.witnesses.back().dot = 4;
  lock.witnesses.back().position_m = target_.dots[4].position_m;
  add(lock);
  EXPECT_EQ(gathered_.ticks(), 1);
}

TEST_F(Gathering, OutlivesAFewMissesAndReachesFurtherByThem) {
  stand(5);
  for (int i = 0; i < GatheredEvidence::kMaxMisses; ++i) gathered_.miss();
  add(at({0.7, 0.0, 0.0}));
  EXPECT_EQ(gathered_.ticks(), 6);
  for (int i = 0; i <= GatheredEvidence::kMaxMisses; ++i) gathered_.miss();
  add(at({0.7, 0.0, 0.0}));
  EXPECT_EQ(gathered_.ticks(), 1);
}

TEST_F(Gathering, LearnsNothingFromTheSameImages) {
  const double once = add(at(Vector3d::Zero()));
  EXPECT_EQ(gathered_.add(at(Vector3d::Zero()), now_), once);
  EXPECT_EQ(gathered_.ticks(), 1);
}

TEST_F(Gathering, StaysAHalfBesideAnEqualRival) {
  for (int i = 0; i < 200; ++i) {
    CandidateLock lock = at({0.05 * i, 0.0, 0.0});
    lock.rivals.push_back(lock.log_odds);
    EXPECT_GE(add(lock), 0.499);
  }
  EXPECT_EQ(gathered_.ticks(), 200);
}

TEST_F(Gathering, RemembersARivalForAFewTicks) {
  CandidateLock lock = at(Vector3d::Zero());
  lock.rivals.push_back(lock.log_odds);
  add(lock);
  double p = 1.0;
  for (int i = 1; i <= 2; ++i) p = add(at({0.1 * i, 0.0, 0.0}));
  EXPECT_GT(p, 1e-6);
  for (int i = 3; i <= 6; ++i) p = add(at({0.1 * i, 0.0, 0.0}));
  EXPECT_LT(p, 1e-6);
}

TEST_F(Gathering, HoldsTheLastCandidateAgainstOneThatIsElsewhere) {
  CandidateLock sure = at(Vector3d::Zero());
  sure.log_odds = 40.0;
  EXPECT_LT(add(sure), 1e-6);
  CandidateLock elsewhere = at({2.0, 0.0, 0.0});
  elsewhere.log_odds = 40.0;
  EXPECT_NEAR(add(elsewhere), 0.5, 0.01);
  EXPECT_EQ(gathered_.ticks(), 1);
}

}  // namespace
}  // namespace dottrack::acquisition
