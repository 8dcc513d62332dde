#include <gtest/gtest.h>

#include "tests/unit/drivers/libgpiod/motor_rig.h"

namespace dottrack::test {
namespace {

using drivers::MotorPhase;
using drivers::MotorSettings;

MotorSettings with_stop() {
  return {.travel_steps = 40, .has_end_stop = true, .has_auto_iris = true};
}
MotorSettings without_stop() {
  return {.travel_steps = 40, .has_auto_iris = true};
}

TEST(IrisHoming, StandsStillAndWithoutCurrentUntilItIsAsked) {
  MotorRig rig(with_stop(), {});
  for (int i = 0; i < 100; ++i) rig.tick();
  EXPECT_EQ(rig.iris.edges(), 0U);
  EXPECT_EQ(rig.iris.pins(), drivers::MotorPins{});
  EXPECT_TRUE(rig.motor.idle());
}

TEST(IrisHoming, FindsTheEndStopAndGoesWhereItWasSent) {
  MotorRig rig(with_stop(), {.start = 17});
  ASSERT_TRUE(rig.go(25));
  EXPECT_EQ(rig.motor.phase(), MotorPhase::at_rest);
  EXPECT_EQ(rig.iris.blades(), 25);
  EXPECT_EQ(rig.iris.edges(), 17U + 25U);
  EXPECT_EQ(rig.motor.steps(), rig.iris.edges());
  EXPECT_EQ(rig.iris.stalls(), 0);
  EXPECT_EQ(rig.iris.violations(), 0);
}

TEST(IrisHoming, LeavesAnEndStopThatItStartsOn) {
  for (const int start : {-3, -1, 0}) {
    MotorRig rig(with_stop(), {.start = start});
    ASSERT_TRUE(rig.go(10)) << start;
    EXPECT_EQ(rig.iris.blades(), 10) << start;
  }
}

TEST(IrisHoming, IgnoresASingleReadingOfTheStop) {
  MotorRig rig(with_stop(), {.start = 30});
  rig.ask(5);
  for (int i = 0; i < 6; ++i) rig.tick();
  rig.iris.break_switch(true);
  while (rig.iris.pins().step) rig.tick();
  rig.tick();
  rig.iris.break_switch(false);
  rig.tick();
  EXPECT_EQ(rig.motor.phase(), MotorPhase::homing);
}

TEST(IrisHoming, WithoutAStopDrivesAgainstTheClosedEnd) {
  for (const int start : {0, 17, 40}) {
    MotorRig rig(without_stop(), {.start = start, .spare = 0});
    ASSERT_TRUE(rig.go(12)) << start;
    EXPECT_EQ(rig.iris.blades(), 12) << start;
    EXPECT_GT(rig.iris.stalls(), 0) << start;
    EXPECT_EQ(rig.iris.violations(), 0) << start;
  }
}

TEST(IrisHoming, HomesOnceOnly) {
  MotorRig rig(without_stop(), {.spare = 0});
  ASSERT_TRUE(rig.go(12));
  const std::uint64_t before = rig.iris.edges();
  ASSERT_TRUE(rig.go(15));
  EXPECT_EQ(rig.iris.edges() - before, 3U);
}

TEST(IrisHoming, HomesAgainAfterTheAutoIrisMovedTheBlades) {
  MotorRig rig(with_stop(), {});
  ASSERT_TRUE(rig.go(12));
  rig.ask(std::nullopt);
  ASSERT_TRUE(rig.settle());
  EXPECT_FALSE(rig.iris.pins().override_auto);
  rig.iris.drift_to(31);
  ASSERT_TRUE(rig.go(12));
  EXPECT_EQ(rig.iris.blades(), 12);
}

TEST(IrisHoming, WithoutAnAutoIrisTheBladesStayWhereTheyAre) {
  MotorRig rig({.travel_steps = 40, .has_end_stop = true}, {});
  ASSERT_TRUE(rig.go(12));
  rig.ask(std::nullopt);
  ASSERT_TRUE(rig.settle());
  const std::uint64_t before = rig.iris.edges();
  ASSERT_TRUE(rig.go(13));
  EXPECT_EQ(rig.iris.edges() - before, 1U);
}

TEST(IrisHoming, AStopThatIsNeverFoundIsAFault) {
  MotorRig rig(with_stop(), {});
  rig.iris.break_switch(false);
  ASSERT_TRUE(rig.go(25));
  EXPECT_EQ(rig.motor.phase(), MotorPhase::faulty);
  EXPECT_GE(rig.iris.edges(), 40U);
  EXPECT_LE(rig.iris.edges(), 50U);
  EXPECT_FALSE(rig.iris.pins().enable);
  EXPECT_TRUE(rig.iris.pins().override_auto);
}

TEST(IrisHoming, AStopThatIsNeverLeftIsAFault) {
  MotorRig rig(with_stop(), {});
  rig.iris.break_switch(true);
  ASSERT_TRUE(rig.go(25));
  EXPECT_EQ(rig.motor.phase(), MotorPhase::faulty);
}

TEST(IrisHoming, AFaultyIrisTriesAgainOnlyAfterARelease) {
  MotorRig rig(with_stop(), {});
  rig.iris.break_switch(false);
  ASSERT_TRUE(rig.go(25));
  const std::uint64_t before = rig.iris.edges();
  ASSERT_TRUE(rig.go(20));
  EXPECT_EQ(rig.iris.edges(), before);

  rig.iris.drift_to(20);
  rig.iris.break_switch(true);
  rig.ask(std::nullopt);
  rig.ask(20);
  rig.tick();
  EXPECT_EQ(rig.motor.phase(), MotorPhase::homing);
}

TEST(IrisHoming, AStopFarFromTheClosedEndIsAFault) {
  MotorRig rig(with_stop(), {});
  ASSERT_TRUE(rig.go(10));
  rig.ask(40);
  ASSERT_TRUE(rig.run_until([&] { return rig.iris.blades() == 25; }));
  rig.iris.break_switch(true);
  ASSERT_TRUE(rig.settle());
  EXPECT_EQ(rig.motor.phase(), MotorPhase::faulty);
  EXPECT_LT(rig.iris.blades(), 30);
}

}  // namespace
}  // namespace dottrack::test
