#include "host_sim/hal/sim_iris.h"

#include <gtest/gtest.h>

#include "rtos_shim/virtual_time/virtual_clock.h"

namespace dottrack::host_sim {
namespace {

Time at_s(double seconds) {
  return Time(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds)));
}

class SimIrises : public testing::Test {
 protected:
  double opening_at(double seconds) {
    clock_.jump_to(at_s(seconds));
    return iris_.state(0).opening;
  }

  rtos::VirtualClock clock_;
  SimIris iris_{2,
                {.opening = 0.8,
                 .min_opening = 0.1,
                 .speed_per_s = 0.5,
                 .backlash = 0.04,
                 .drift_per_s = 0.1},
                clock_};
};

TEST_F(SimIrises, AnAutomaticOneDriftsUpToItsRange) {
  EXPECT_TRUE(iris_.state(0).automatic);
  EXPECT_NEAR(opening_at(1.0), 0.88, 1e-9);
  EXPECT_NEAR(iris_.opening(0, at_s(2.0)), 0.96, 1e-9);
  EXPECT_EQ(opening_at(60.0), 1.0);
}

TEST_F(SimIrises, ARequestMovesItAtItsSpeedAndItStopsWithinThePlay) {
  ASSERT_TRUE(iris_.move_to(0, 0.4));
  EXPECT_FALSE(iris_.state(0).automatic);
  EXPECT_TRUE(iris_.state(0).moving);
  EXPECT_NEAR(opening_at(0.4), 0.8 - 0.2 + 0.02, 1e-9);
  EXPECT_NEAR(opening_at(2.0), 0.42, 1e-9);
  EXPECT_FALSE(iris_.state(0).moving);
  EXPECT_NEAR(iris_.state(1).opening, 0.96, 1e-9) << "the other one is its lens's";
}

TEST_F(SimIrises, AChangeOfDirectionLosesTheBacklash) {
  ASSERT_TRUE(iris_.move_to(0, 0.4));
  EXPECT_NEAR(opening_at(2.0), 0.42, 1e-9);
  ASSERT_TRUE(iris_.move_to(0, 0.43));
  EXPECT_NEAR(opening_at(3.0), 0.42, 1e-9) << "all of it was play";
  ASSERT_TRUE(iris_.move_to(0, 0.6));
  EXPECT_NEAR(opening_at(5.0), 0.58, 1e-9);
}

TEST_F(SimIrises, HowOftenItIsAskedChangesNothing) {
  SimIris asked(1, {.opening = 0.9}, clock_);
  SimIris left_alone(1, {.opening = 0.9}, clock_);
  ASSERT_TRUE(asked.move_to(0, 0.2));
  ASSERT_TRUE(left_alone.move_to(0, 0.2));
  for (int i = 1; i < 50; ++i) {
    clock_.jump_to(at_s(0.02 * i));
    asked.state(0);
  }
  EXPECT_EQ(asked.state(0).opening, left_alone.state(0).opening);
}

TEST_F(SimIrises, WhatCannotBeIsRefused) {
  EXPECT_FALSE(iris_.move_to(2, 0.5));
  EXPECT_FALSE(iris_.move_to(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(iris_.state(0).automatic);
  ASSERT_TRUE(iris_.move_to(0, 0.0));
  EXPECT_NEAR(opening_at(9.0), 0.12, 1e-9) << "no further than it closes";
  ASSERT_TRUE(iris_.release_to_auto(0));
  EXPECT_TRUE(iris_.state(0).automatic);
}

TEST_F(SimIrises, StuckBladesStayWhileTheMotorGoesOn) {
  SimIris iris(2, {.opening = 0.8, .backlash = 0.0}, clock_,
               {{.camera = 1, .kind = IrisFaultKind::stuck, .from_s = 1.0}});
  for (const std::size_t camera : {0U, 1U}) ASSERT_TRUE(iris.move_to(camera, 0.1));
  clock_.jump_to(at_s(2.0));
  EXPECT_NEAR(iris.opening(0, at_s(2.0)), 0.1, 1e-9);
  EXPECT_NEAR(iris.opening(1, at_s(2.0)), 0.3, 1e-9) << "where it was when it stuck";
  EXPECT_NEAR(iris.state(1).opening, 0.1, 1e-9) << "the motor knows nothing of it";
  ASSERT_TRUE(iris.move_to(1, 0.6));
  clock_.jump_to(at_s(5.0));
  EXPECT_NEAR(iris.opening(1, at_s(5.0)), 0.3, 1e-9);
  EXPECT_NEAR(iris.state(1).opening, 0.6, 1e-9);
  EXPECT_TRUE(iris.state(1).healthy);
}

TEST_F(SimIrises, ADeadOneDoesNotAnswer) {
  SimIris iris(1, {}, clock_, {{.camera = 0, .kind = IrisFaultKind::dead, .from_s = 1.0}});
  EXPECT_TRUE(iris.state(0).healthy);
  clock_.jump_to(at_s(1.0));
  EXPECT_FALSE(iris.state(0).healthy);
}

TEST_F(SimIrises, WearChangesTheLightAndNotWhatTheIrisSays) {
  SimIris iris(1, {.opening = 0.5, .wear_per_s = 0.1}, clock_);
  ASSERT_TRUE(iris.move_to(0, 0.5));
  clock_.jump_to(at_s(2.0));
  EXPECT_NEAR(iris.opening(0, at_s(2.0)), 0.6, 1e-9);
  EXPECT_NEAR(iris.state(0).opening, 0.5, 1e-9);
}

}  // namespace
}  // namespace dottrack::host_sim
