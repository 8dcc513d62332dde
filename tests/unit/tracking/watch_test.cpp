// The watch over tracking, and what happens to locks that may be chance.

#include <gtest/gtest.h>

#include "app/core/tracker.h"
#include "tests/unit/tracking/painted_room.h"

namespace dottrack::core {
namespace {

using test::PaintedRoom;
using test::Vector3d;

// Something that looks like the vehicle: every dot a little off.
void paint_look_alike(PaintedRoom& room, const Pose& pose, double off_m) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-off_m, off_m);
  for (const TargetDot& dot : room.rig.target.dots) {
    const Vector3d error(part(random), part(random), part(random));
    for (std::size_t camera = 0; camera < room.rig.cameras.size(); ++camera) {
      room.paint(camera, pose.orientation * dot.position_m + pose.position_m + error,
                 dot.diameter_m);
    }
  }
}

bool is_at(const TickResult& result, const Pose& pose) {
  return result.has_pose && test::position_error_m(result, pose) < 0.03 &&
         test::attitude_error_deg(result, pose) < 3.0;
}

class WatchTest : public testing::Test {
 protected:
  // The tracker follows the look-alike, which is all there is; then the vehicle shows.
  void be_led_astray(Tracker& tracker) {
    room_.clear();
    paint_look_alike(room_, decoy_, 0.012);
    const TickResult& wrong = tracker.step(room_.frames());
    ASSERT_TRUE(is_at(wrong, decoy_)) << to_string(wrong.reason);
    room_.paint_vehicle(vehicle_);
  }

  PaintedRoom room_{8};
  Pose decoy_ = PaintedRoom::pose_at(3.2, 2.4, 0.3);
  Pose vehicle_ = PaintedRoom::pose_at(5.2, 3.6, 1.9);
};

TEST_F(WatchTest, AWrongLockLivesForThreeTicksAtMost) {
  Tracker tracker(room_.rig);
  be_led_astray(tracker);
  int wrong = 1;
  TickResult result;
  for (; wrong < 10; ++wrong) {
    result = tracker.step(room_.frames());
    if (is_at(result, vehicle_)) break;
    EXPECT_TRUE(is_at(result, decoy_));
    EXPECT_EQ(result.relock, Relock::none);
  }
  EXPECT_LE(wrong, 3);
  EXPECT_EQ(result.relock, Relock::better_elsewhere);
  EXPECT_EQ(result.reset_count, 2U);
  EXPECT_FALSE(result.filtered.motion.known);
  EXPECT_LE(result.false_lock_probability, room_.rig.limits.max_false_lock_probability);
}

TEST_F(WatchTest, AWrongLabellingInTheSamePlaceDoesNotStay) {
  // The look-alike of the vehicle turned round: their dots are each other's clutter.
  decoy_ = PaintedRoom::pose_at(4.2, 3.0, 0.3);
  vehicle_ = PaintedRoom::pose_at(4.3, 3.1, 0.3 + 2.1);
  Tracker tracker(room_.rig);
  be_led_astray(tracker);
  for (int tick = 1; tick < 20; ++tick) {
    const TickResult& result = tracker.step(room_.frames());
    if (tick < 3 || !result.has_pose) continue;
    EXPECT_TRUE(is_at(result, vehicle_)) << tick;
  }
}

TEST_F(WatchTest, WithoutTheWatchAWrongLockStays) {
  room_.rig.limits.watch_every_ticks = 0;
  Tracker tracker(room_.rig);
  be_led_astray(tracker);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(is_at(tracker.step(room_.frames()), decoy_));
}

TEST_F(WatchTest, TwinsDoNotTakeTurns) {
  Tracker tracker(room_.rig);
  room_.clear();
  room_.paint_vehicle(vehicle_);
  ASSERT_TRUE(is_at(tracker.step(room_.frames()), vehicle_));
  for (int i = 0; i < 30; ++i) {
    room_.clear();
    room_.paint_vehicle(vehicle_);
    room_.paint_vehicle(PaintedRoom::pose_at(2.5 + 0.02 * i, 2.4, 0.1 * i));
    const TickResult& result = tracker.step(room_.frames());
    EXPECT_TRUE(is_at(result, vehicle_)) << i;
    EXPECT_EQ(result.reset_count, 1U) << i;
  }
}

TEST_F(WatchTest, TwinsAreNotLockedOnTo) {
  Tracker tracker(room_.rig);
  room_.clear();
  room_.paint_vehicle(vehicle_);
  room_.paint_vehicle(decoy_);
  for (int i = 0; i < 10; ++i) {
    const TickResult& result = tracker.step(room_.frames());
    EXPECT_FALSE(result.has_pose);
    EXPECT_EQ(result.reason, Reason::ambiguous);
    EXPECT_TRUE(result.has_candidate);
    EXPECT_GE(result.acquisition.false_lock_probability, 0.05);
  }
}

TEST_F(WatchTest, WhereTrackingFailsTheVehicleIsFoundInTheSameTick) {
  Tracker tracker(room_.rig);
  room_.clear();
  room_.paint_vehicle(vehicle_);
  ASSERT_TRUE(is_at(tracker.step(room_.frames()), vehicle_));
  room_.clear();
  room_.paint_vehicle(decoy_);  // carried there
  const TickResult& result = tracker.step(room_.frames());
  EXPECT_TRUE(is_at(result, decoy_));
  EXPECT_EQ(result.reset_count, 2U);
  EXPECT_EQ(result.relock, Relock::none);
}

// A symmetric target: which way round it stands, nobody can tell.
TEST_F(WatchTest, ASymmetricTargetIsNeverLockedOnTo) {
  Rig& rig = room_.rig;
  rig.target.dots.clear();
  for (const Vector3d& p : {Vector3d(0.3, 0.3, 0.0), Vector3d(-0.3, 0.3, 0.0),
                            Vector3d(-0.3, -0.3, 0.0), Vector3d(0.3, -0.3, 0.0)}) {
    rig.target.dots.push_back({p, 0.1, {}});
  }
  Tracker tracker(rig);
  room_.clear();
  room_.paint_vehicle(vehicle_);
  for (int i = 0; i < 5; ++i) {
    const TickResult& result = tracker.step(room_.frames());
    EXPECT_FALSE(result.has_pose);
    EXPECT_EQ(result.reason, Reason::ambiguous);
  }
}

class HeldBackTest : public testing::Test {
 protected:
  // Three dots among clutter that offers a triangle by chance now and then.
  const TickResult& show(Tracker& tracker, const Pose& pose) {
    room_.clear();
    room_.paint_vehicle(pose);
    room_.paint_clutter(6, 12);
    time_ += std::chrono::milliseconds(100);
    return tracker.step(room_.frames(time_));
  }

  PaintedRoom room_{3};
  Time time_{};
};

TEST_F(HeldBackTest, ThreeDotsThatStandStillAreNotBelieved) {
  Tracker tracker(room_.rig);
  const Pose pose = PaintedRoom::pose_at(4.2, 2.8, 1.0);
  int held_back = 0;
  for (int i = 0; i < 10; ++i) {
    const TickResult& result = show(tracker, pose);
    EXPECT_FALSE(result.has_pose) << i;
    held_back += result.reason == Reason::held_back ? 1 : 0;
  }
  EXPECT_GE(held_back, 8);
}

TEST_F(HeldBackTest, ThreeDotsThatMoveAsOneAreBelievedSoon) {
  Tracker tracker(room_.rig);
  int ticks = 0;
  bool locked = false;
  for (; ticks < 12 && !locked; ++ticks) {
    const Pose pose = PaintedRoom::pose_at(4.0 + 0.06 * ticks, 2.8, 1.0);
    const TickResult& result = show(tracker, pose);
    locked = result.has_pose;
    EXPECT_EQ(locked, is_at(result, pose));
  }
  EXPECT_TRUE(locked);
  EXPECT_GT(ticks, 1);
}

}  // namespace
}  // namespace dottrack::core
