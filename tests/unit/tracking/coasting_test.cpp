// The filter in the tracker: fast vehicles, targets that are not seen for a while, jumps.

#include <gtest/gtest.h>

#include "tests/unit/tracking/painted_room.h"

namespace dottrack::core {
namespace {

using std::chrono::milliseconds;
using test::PaintedRoom;

class CoastingTest : public testing::Test {
 protected:
  static constexpr Duration kTick = milliseconds(33);

  Time now() const { return Time{} + (tick_ + 1) * kTick; }
  double seconds() const { return to_seconds(now().time_since_epoch()); }

  // Along x, from x = 2.5 m.
  Pose there(double speed_m_s) const {
    return PaintedRoom::pose_at(2.5 + speed_m_s * seconds(), 3.0, 0.3 + 0.5 * seconds());
  }

  const TickResult& show(const Pose& pose) {
    room_.clear();
    room_.paint_vehicle(pose);
    return look();
  }
  const TickResult& show_nothing() {
    room_.clear();
    return look();
  }
  const TickResult& look() {
    const TickResult& result = tracker_.step(room_.frames(now()));
    ++tick_;
    return result;
  }

  PaintedRoom room_{5};
  Tracker tracker_{room_.rig};
  int tick_ = 0;
};

// Its dots move by a diameter and a half from tick to tick, further than a window about their last
// place reaches.
TEST_F(CoastingTest, FollowsAVehicleThatIsFasterThanItsWindows) {
  constexpr double kSpeed = 4.0;
  room_.rig.vehicle.max_speed_m_s = 5.0;
  room_.rig.vehicle.max_acceleration_m_s2 = 10.0;
  Tracker tracker(room_.rig);
  double from_rest = 2.5;
  for (int i = 0; i < 24; ++i) {
    const double speed = std::min(kSpeed, 10.0 * i * to_seconds(kTick));
    from_rest += speed * to_seconds(kTick);
    const Pose pose = PaintedRoom::pose_at(from_rest, 3.0, 0.3);
    room_.clear();
    room_.paint_vehicle(pose);
    const TickResult& result = tracker.step(room_.frames(now()));
    ++tick_;
    ASSERT_TRUE(result.has_pose) << i;
    EXPECT_LT(test::position_error_m(result, pose), 0.002) << i;
    EXPECT_EQ(result.reset_count, 1U) << i;
  }
}

TEST_F(CoastingTest, GoesOnWhileTheTargetIsNotSeenAndSaysSo) {
  constexpr double kSpeed = 0.8;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(show(there(kSpeed)).has_pose) << i;
  double sigma_m = 0.0;
  for (int i = 0; i < 14; ++i) {  // 462 ms
    const Pose truth = there(kSpeed);
    const TickResult& result = show_nothing();
    EXPECT_FALSE(result.has_pose);
    EXPECT_NE(result.reason, Reason::none);
    EXPECT_EQ(result.state, State::tracking);
    ASSERT_TRUE(result.filtered.known) << i;
    EXPECT_TRUE(result.filtered.coasting);
    const double grown_m = std::sqrt(result.filtered.pose.covariance(0, 0));
    EXPECT_GT(grown_m, sigma_m) << i;
    sigma_m = grown_m;
    EXPECT_LT((result.filtered.pose.position_m - truth.position_m).norm(), 4.0 * sigma_m) << i;
  }
  EXPECT_GT(sigma_m, 0.01);
  const Pose truth = there(kSpeed);
  const TickResult& again = show(truth);
  ASSERT_TRUE(again.has_pose);
  EXPECT_LT(test::position_error_m(again, truth), 0.002);
  EXPECT_FALSE(again.filtered.coasting);
  EXPECT_EQ(again.reset_count, 1U);
}

TEST_F(CoastingTest, EndsAfterItsTime) {
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(show(there(0.2)).has_pose);
  int coasting = 0;
  const TickResult* result = nullptr;
  for (int i = 0; i < 20; ++i) {
    result = &show_nothing();
    coasting += result->filtered.coasting ? 1 : 0;
    EXPECT_EQ(result->filtered.coasting, result->filtered.known);
  }
  EXPECT_EQ(coasting, 15);  // of 500 ms
  EXPECT_EQ(result->state, State::acquiring);
  EXPECT_EQ(show(there(0.2)).reset_count, 2U);
}

TEST_F(CoastingTest, CanBeTurnedOff) {
  room_.rig.limits.coast = {};
  Tracker tracker(room_.rig);
  for (int i = 0; i < 3; ++i) {
    room_.clear();
    room_.paint_vehicle(there(0.2));
    ASSERT_TRUE(tracker.step(room_.frames(now())).has_pose);
    ++tick_;
  }
  room_.clear();
  EXPECT_FALSE(tracker.step(room_.frames(now())).filtered.known);
}

// 5 cm in 33 ms, where 1 m/s is the most: carried, or struck.
TEST_F(CoastingTest, AJumpIsAResetAndNotASmear) {
  room_.rig.vehicle.max_speed_m_s = 0.5;
  room_.rig.vehicle.max_acceleration_m_s2 = 0.5;
  Tracker tracker(room_.rig);
  const auto at = [&](double x) -> const TickResult& {
    room_.clear();
    room_.paint_vehicle(PaintedRoom::pose_at(x, 3.0, 0.3));
    const TickResult& result = tracker.step(room_.frames(now()));
    ++tick_;
    return result;
  };
  for (int i = 0; i < 10; ++i) EXPECT_EQ(at(4.0).reset_count, 1U);
  const TickResult& jumped = at(4.06);
  ASSERT_TRUE(jumped.has_pose);
  EXPECT_EQ(jumped.relock, Relock::jumped);
  EXPECT_EQ(jumped.reset_count, 2U);
  EXPECT_NEAR(jumped.filtered.pose.position_m.x(), 4.06, 0.002);
  EXPECT_FALSE(jumped.filtered.motion.known);
  EXPECT_EQ(at(4.06).reset_count, 2U);
}

// What is predicted for the next tick is where the vehicle is then.
TEST_F(CoastingTest, PredictsTheMomentOfSending) {
  constexpr double kSpeed = 0.8;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(show(there(kSpeed)).has_pose) << i;
  const FilteredPose ahead = tracker_.predicted(now());
  ASSERT_TRUE(ahead.known);
  EXPECT_LT((ahead.pose.position_m - there(kSpeed).position_m).norm(), 0.003);
  EXPECT_GT(ahead.pose.covariance(0, 0), tracker_.predicted(now() - kTick).pose.covariance(0, 0));
}

}  // namespace
}  // namespace dottrack::core
