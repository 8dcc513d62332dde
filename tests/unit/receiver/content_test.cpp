// What a sound group says, and what no group may say.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

struct Fault {
  std::string name;
  std::function<void(Group&)> make;
};

const std::vector<Fault>& impossible() {
  static const std::vector<Fault> kFaults{
      {"state 2", [](Group& g) { g.state = 2; }},
      {"state 3", [](Group& g) { g.state = 3; }},
      {"17 dots used", [](Group& g) { g.dots_used = 17; }},
      {"31 dots used", [](Group& g) { g.dots_used = 31; }},
      {"17 dots follow", [](Group& g) { g.dots_follow = 17; }},
      {"valid and out of range", [](Group& g) { g.out_of_range = true; }},
      {"valid without x", [](Group& g) { g.position[0] = -8388608; }},
      {"valid without z", [](Group& g) { g.position[2] = -8388608; }},
      {"valid without qw", [](Group& g) { g.orientation[0] = -32768; }},
      {"valid without qz", [](Group& g) { g.orientation[3] = -32768; }},
      {"quaternion too short", [](Group& g) { g.orientation[0] = 32258 - 17; }},
      {"quaternion too long", [](Group& g) { g.orientation[1] = 1100; }},
      {"quaternion of zeros", [](Group& g) { g.orientation.fill(0); }},
      {"position without a pose", [](Group& g) { g.valid = false; }},
      {"visibility 3", [](Group& g) { g.dots[3].visibility = 3; }},
      {"correlation above 1", [](Group& g) { g.correlation[14] = g.fd ? 63 : 251; }},
      {"correlation below -1", [](Group& g) { g.correlation[0] = g.fd ? -63 : -255; }},
  };
  return kFaults;
}

Group full(Unit& unit) {
  Group group = unit.next();
  group.covariance = group.motion = group.cameras = true;
  group.dots_follow = 4;
  return group;
}

TEST(ReceiverContent, WhatTheLayoutDoesNotAllowIsCorrupted) {
  EXPECT_GE(impossible().size(), 17U);
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    Listener listener;
    std::uint64_t corrupted = 0;
    for (const Fault& fault : impossible()) {
      ASSERT_EQ(listener.take(full(unit)), DOTTRACK_FRESH) << fault.name;
      const std::uint64_t shown = listener.pose().capture_us;
      Group group = full(unit);
      fault.make(group);
      // Content is judged with the whole group; 17 dots announce no messages.
      const Frames frames = frames_of(group);
      const std::uint64_t before = listener.verdicts(DOTTRACK_CORRUPTED);
      (void)listener.push(frames, unit.arrival_us());
      EXPECT_EQ(listener.verdicts(DOTTRACK_CORRUPTED), before + 1) << fault.name;
      EXPECT_EQ(listener.counts().corrupted, ++corrupted) << fault.name;
      EXPECT_EQ(listener.pose().capture_us, shown) << fault.name;
    }
    EXPECT_EQ(listener.counts().incomplete, 0U);
  }
}

TEST(ReceiverContent, WhatANewerUnitMaySayIsNotCorrupted) {
  Unit unit;
  Listener listener;
  Group group = unit.next();
  group.reason = 255;
  group.degraded = 0xFFFF;
  EXPECT_EQ(listener.push(group, unit.arrival_us()), DOTTRACK_FRESH);
  EXPECT_EQ(listener.pose().reason, 255);
  EXPECT_EQ(listener.pose().degraded, 0xFFFF);
}

TEST(ReceiverContent, WithoutAPoseTheGroupIsFreshAndNotValid) {
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    Listener listener;
    ASSERT_EQ(listener.take(full(unit)), DOTTRACK_FRESH);
    ASSERT_TRUE(listener.pose().valid);
    Group group = full(unit);
    take_pose_away(group);
    group.state = DOTTRACK_ACQUIRING;
    group.reason = 4;
    ASSERT_EQ(listener.push(group, unit.arrival_us()), DOTTRACK_FRESH);
    const dottrack_pose& pose = listener.pose();
    EXPECT_FALSE(pose.valid);
    EXPECT_EQ(pose.state, DOTTRACK_ACQUIRING);
    EXPECT_STREQ(dottrack_reason_text(pose.reason), "too_few_finalists");
    EXPECT_FALSE(pose.has_covariance);
    EXPECT_EQ(std::to_array(pose.position_m), (std::array{0.0, 0.0, 0.0}));
    EXPECT_EQ(std::to_array(pose.orientation_wxyz), (std::array{0.0, 0.0, 0.0, 0.0}));
    EXPECT_LT(pose.residual_m, 0.0);
    EXPECT_LT(pose.false_lock_probability, 0.0);
  }
}

TEST(ReceiverContent, APoseOutOfRangeSaysSo) {
  Unit unit;
  Listener listener;
  Group group = unit.next();
  take_pose_away(group);
  group.out_of_range = true;
  ASSERT_EQ(listener.push(group, unit.arrival_us()), DOTTRACK_FRESH);
  EXPECT_TRUE(listener.pose().out_of_range);
  EXPECT_FALSE(listener.pose().valid);
}

TEST(ReceiverContent, WhatIsNotAvailableIsNotThere) {
  Unit unit;
  Listener listener;
  Group group = full(unit);
  group.residual = 255;
  group.false_lock = 255;
  group.velocity[1] = -32768;
  group.rates.fill(-32768);
  group.sigma.fill(65535);
  group.correlation.fill(-256);
  group.dots[1] = {{-8388608, -8388608, -8388608}, 0, 0, 63};
  ASSERT_EQ(listener.push(group, unit.arrival_us()), DOTTRACK_FRESH);
  const dottrack_pose& pose = listener.pose();
  EXPECT_LT(pose.residual_m, 0.0);
  EXPECT_LT(pose.false_lock_probability, 0.0);
  EXPECT_FALSE(pose.has_velocity);
  EXPECT_FALSE(pose.has_rates);
  EXPECT_FALSE(pose.has_covariance);
  EXPECT_TRUE(pose.dot[0].has_position);
  EXPECT_FALSE(pose.dot[1].has_position);
  EXPECT_LT(pose.dot[1].sigma_m, 0.0);
}

TEST(ReceiverContent, WhatIsNotAnnouncedIsNotTakenFromTheGroupBefore) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(full(unit)), DOTTRACK_FRESH);
  ASSERT_TRUE(listener.pose().has_covariance && listener.pose().has_velocity &&
              listener.pose().has_cameras && listener.pose().dots == 4);
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  const dottrack_pose& pose = listener.pose();
  EXPECT_FALSE(pose.has_covariance || pose.has_velocity || pose.has_rates || pose.has_cameras);
  EXPECT_EQ(pose.dots, 0);
}

TEST(ReceiverContent, TheOrientationIsAUnitQuaternion) {
  std::mt19937_64 random(3);
  Unit unit;
  Listener listener;
  for (unsigned i = 0; i < 5000; ++i) {
    Group group = unit.next();
    group.orientation = random_group(random, false).orientation;
    if (group.orientation[0] == -32768) group.orientation = {32258, 0, 0, 0};
    ASSERT_EQ(listener.push(group, unit.arrival_us()), DOTTRACK_FRESH);
    double norm = 0.0;
    for (const double component : listener.pose().orientation_wxyz) norm += component * component;
    ASSERT_NEAR(norm, 1.0, 4e-9);
  }
  Group rough = unit.next();
  rough.orientation[0] = 32258 - 15;  // as far off as is let through
  ASSERT_EQ(listener.push(rough, unit.arrival_us()), DOTTRACK_FRESH);
  EXPECT_NEAR(listener.pose().orientation_wxyz[0], 1.0, 4e-7);
}

TEST(ReceiverContent, FalseLockIsAPowerOfHalf) {
  Unit unit;
  Listener listener;
  double expected = 1.0;
  for (unsigned k = 0; k <= 254; ++k) {
    unit.shape.false_lock = static_cast<std::uint8_t>(k);
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
    ASSERT_EQ(listener.pose().false_lock_probability, expected) << k;
    expected /= 2.0;
  }
}

}  // namespace
}  // namespace dottrack::receiver_test
