// What the tracker learns of how far the dots are off, from tick to tick.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

#include "app/core/tracker.h"
#include "tests/unit/tracking/painted_room.h"

namespace dottrack::core {
namespace {

using test::PaintedRoom;
using test::Vector3d;

constexpr double kOff_m = 0.002;

// The vehicle with its dots off what the target's file says, each coordinate by up to so much.
void put_dots_off(PaintedRoom& room, double off_m) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-off_m, off_m);
  for (TargetDot& dot : room.rig.target.dots) {
    dot.position_m += Vector3d(part(random), part(random), part(random));
  }
}

TEST(LearntPlaces, ShowAndAreRememberedForSomeTicks) {
  const Pose pose = PaintedRoom::pose_at(4.2, 3.0, 0.3);
  PaintedRoom said(8);
  said.clear();
  said.paint_vehicle(pose);
  PaintedRoom built(8);
  put_dots_off(built, kOff_m);
  built.clear();
  built.paint_vehicle(pose);
  Tracker tracker(said.rig);
  for (int tick = 0; tick < 5; ++tick) {
    const TickResult& result = tracker.step(built.frames(Time{std::chrono::milliseconds(tick)}));
    ASSERT_TRUE(result.has_pose) << tick;
    EXPECT_NEAR(result.dot_sigma_m, kOff_m / std::sqrt(3.0), 0.4 * kOff_m) << tick;
  }
  const TickResult& next = tracker.step(said.frames(Time{std::chrono::milliseconds(5)}));
  ASSERT_TRUE(next.has_pose);
  EXPECT_GT(next.dot_sigma_m, 0.3 * kOff_m);

  Tracker fresh(said.rig);
  const TickResult& first = fresh.step(said.frames());
  ASSERT_TRUE(first.has_pose);
  EXPECT_LT(first.dot_sigma_m, 0.1 * kOff_m);
}

}  // namespace
}  // namespace dottrack::core
