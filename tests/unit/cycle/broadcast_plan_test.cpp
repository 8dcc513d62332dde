#include "app/cycle/broadcast_plan.h"

#include <gtest/gtest.h>

namespace dottrack::cycle {
namespace {

protocol::Rates rates(unsigned pose_every) {
  protocol::Rates rates;
  rates.pose_every = pose_every;
  return rates;
}

Announcement tracking(std::uint8_t lock = 1) {
  return {core::State::tracking, true, lock, {}};
}

// How many of so many ticks send a group.
int groups(BroadcastPlan& plan, int ticks, const Announcement& announcement) {
  int groups = 0;
  for (int i = 0; i < ticks; ++i) {
    if (!plan.next(announcement)) continue;
    plan.sent_whole(true);
    ++groups;
  }
  return groups;
}

TEST(BroadcastPlan, SendsAGroupEveryTickOrEverySoMany) {
  BroadcastPlan each(rates(1));
  EXPECT_EQ(groups(each, 12, tracking()), 12);
  BroadcastPlan fourth(rates(4));
  EXPECT_EQ(groups(fourth, 1, tracking()), 1) << "the first at once";
  EXPECT_EQ(groups(fourth, 3, tracking()), 0);
  EXPECT_EQ(groups(fourth, 9, tracking()), 3);
}

TEST(BroadcastPlan, ChangesOfStateGoOutAtOnce) {
  BroadcastPlan plan(rates(100));
  groups(plan, 1, tracking());
  EXPECT_EQ(groups(plan, 5, tracking()), 0);
  const Announcement lost{core::State::tracking, false, 1, {}};
  EXPECT_EQ(groups(plan, 5, lost), 1) << "no pose";
  const Announcement acquiring{core::State::acquiring, false, 1, {}};
  EXPECT_EQ(groups(plan, 5, acquiring), 1) << "another state";
  EXPECT_EQ(groups(plan, 5, tracking(2)), 1) << "a new lock";
  Announcement worse = tracking(2);
  worse.degraded.insert(protocol::Degraded::camera_missing);
  EXPECT_EQ(groups(plan, 5, worse), 1) << "a degraded reason";
  EXPECT_EQ(groups(plan, 5, tracking(2)), 1) << "and its end";
}

TEST(BroadcastPlan, AGroupThatWasCutShortIsMadeUpForInTheNextTick) {
  BroadcastPlan plan(rates(50));
  ASSERT_TRUE(plan.next(tracking()));
  plan.sent_whole(false);
  ASSERT_TRUE(plan.next(tracking()));
  plan.sent_whole(true);
  EXPECT_FALSE(plan.next(tracking()));
}

TEST(BroadcastPlan, LightWaitsForAWholeGroup) {
  protocol::Rates asked;
  asked.light_every = 1;
  BroadcastPlan plan(asked);
  ASSERT_TRUE(plan.next(tracking()));
  plan.sent_whole(false);
  EXPECT_FALSE(plan.light_due());
  ASSERT_TRUE(plan.next(tracking()));
  plan.sent_whole(true);
  EXPECT_TRUE(plan.light_due());
}

TEST(BroadcastPlan, EveryMessageHasARateOfItsOwn) {
  protocol::Rates asked;
  asked.covariance_every = 2;
  asked.motion_every = 3;
  asked.cameras_every = 0;
  asked.dots_every = 5;
  asked.identity_every = 6;
  asked.light_every = 16;
  BroadcastPlan plan(asked);
  int covariance = 0, motion = 0, cameras = 0, dots = 0, identity = 0, light = 0;
  for (int i = 0; i < 60; ++i) {
    const auto parts = plan.next(tracking());
    ASSERT_TRUE(parts);
    covariance += parts->covariance ? 1 : 0;
    motion += parts->motion ? 1 : 0;
    cameras += parts->cameras ? 1 : 0;
    dots += parts->dots ? 1 : 0;
    identity += plan.identity_due() ? 1 : 0;
    plan.sent_whole(true);
    light += plan.light_due() ? 1 : 0;
  }
  EXPECT_EQ(covariance, 30);
  EXPECT_EQ(motion, 20);
  EXPECT_EQ(cameras, 0) << "never";
  EXPECT_EQ(dots, 12);
  EXPECT_EQ(identity, 10);
  EXPECT_EQ(light, 4);
}

}  // namespace
}  // namespace dottrack::cycle
