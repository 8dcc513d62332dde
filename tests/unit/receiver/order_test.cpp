// Which groups are newer than which: poses among themselves, whatever is told without pictures.

#include <gtest/gtest.h>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

// A tick without pictures: its own instant, just now, instead of an exposure.
Group without_pictures(Unit& unit) {
  Group group = unit.next();
  group.capture_us += 100U * group.age;
  group.age = 0;
  take_pose_away(group);
  return group;
}

// A pose from pictures that were so much longer on their way from the camera.
Group late_pose(Unit& unit, std::uint64_t later_us) {
  Group group = unit.next();
  group.capture_us -= later_us;
  group.age = static_cast<std::uint16_t>(group.age + later_us / 100);
  return group;
}

TEST(ReceiverOrder, ATickWithoutPicturesDoesNotOvertakeThePosesThatFollow) {
  Unit unit;
  Listener listener;
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
    ASSERT_EQ(listener.take(without_pictures(unit)), DOTTRACK_FRESH);
    EXPECT_FALSE(listener.pose().valid);
    ASSERT_EQ(listener.take(late_pose(unit, 25'000)), DOTTRACK_FRESH)
        << "older than the one before";
    EXPECT_TRUE(listener.pose().valid);
    EXPECT_EQ(listener.pose().age_us, 45'000U);
  }
  EXPECT_EQ(listener.counts().stale, 0U);
  EXPECT_EQ(listener.counts().restarts, 0U);
}

TEST(ReceiverOrder, APoseOlderThanTheLastPoseIsStaleWhateverCameBetween) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  ASSERT_EQ(listener.take(without_pictures(unit)), DOTTRACK_FRESH);
  EXPECT_EQ(listener.take(late_pose(unit, 70'000)), DOTTRACK_STALE);
  EXPECT_EQ(listener.counts().stale, 1U);
}

TEST(ReceiverOrder, ThePictureOfTheLastPoseIsARepetitionWhateverCameBetween) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  ASSERT_EQ(listener.take(without_pictures(unit)), DOTTRACK_FRESH);
  EXPECT_EQ(listener.take(late_pose(unit, 2 * Unit::kPeriodUs)), DOTTRACK_REPEATED);
  EXPECT_EQ(listener.counts().repeated_groups, 1U);
}

// Its clock began anew, and so did the order of its poses.
TEST(ReceiverOrder, AUnitThatRestartsAndHasNoPoseAtFirstIsTakenUpAgain) {
  Unit unit;
  Listener listener;
  for (int i = 0; i < 100; ++i) ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  std::uint64_t now = unit.arrival_us() + 5'000'000;
  Unit again;
  again.sequence = 0;
  again.capture_us = 1'000'000;
  ASSERT_EQ(listener.push(without_pictures(again), now), DOTTRACK_FRESH);
  EXPECT_TRUE(listener.pose().restarted);
  for (int i = 0; i < 30; ++i) {
    now += Unit::kPeriodUs;
    ASSERT_EQ(listener.push(again.next(), now), DOTTRACK_FRESH) << i;
    EXPECT_TRUE(listener.pose().valid);
  }
  EXPECT_EQ(listener.counts().restarts, 1U);
}

}  // namespace
}  // namespace dottrack::receiver_test
