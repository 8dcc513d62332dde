#include "drivers/libgpiod/iris_motor.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/drivers/libgpiod/motor_rig.h"

namespace dottrack::test {
namespace {

using drivers::MotorPhase;
using drivers::MotorSettings;
using std::chrono::milliseconds;

MotorSettings settings(int backlash) {
  return {
      .travel_steps = 40, .backlash_steps = backlash, .has_end_stop = true, .has_auto_iris = true};
}

TEST(IrisMotor, TakesUpTheBacklashBothWays) {
  MotorRig rig(settings(4), {.play = 4});
  ASSERT_TRUE(rig.go(20));
  EXPECT_EQ(rig.iris.blades(), 20);

  const std::uint64_t opened = rig.iris.edges();
  ASSERT_TRUE(rig.go(15));
  EXPECT_EQ(rig.iris.blades(), 15);
  EXPECT_EQ(rig.iris.edges() - opened, 5U + 4U);

  const std::uint64_t closed = rig.iris.edges();
  ASSERT_TRUE(rig.go(16));
  EXPECT_EQ(rig.iris.blades(), 16);
  EXPECT_EQ(rig.iris.edges() - closed, 1U + 4U);

  const std::uint64_t further = rig.iris.edges();
  ASSERT_TRUE(rig.go(18));
  EXPECT_EQ(rig.iris.edges() - further, 2U);
}

TEST(IrisMotor, ABacklashThatIsNotTakenUpShows) {
  MotorRig rig(settings(0), {.play = 4});
  ASSERT_TRUE(rig.go(20));
  EXPECT_EQ(rig.iris.blades(), 16);
}

TEST(IrisMotor, ANewerRequestTurnsItRoundInTheMiddle) {
  MotorRig rig(settings(3), {.play = 3});
  ASSERT_TRUE(rig.go(10));
  rig.ask(35);
  ASSERT_TRUE(rig.run_until([&] { return rig.iris.blades() == 20; }));
  rig.ask(5);
  ASSERT_TRUE(rig.run_until([&] { return !rig.iris.pins().opening; }));
  for (int i = 0; i < 3; ++i) rig.tick();
  rig.ask(30);  // while the backlash is half taken up
  ASSERT_TRUE(rig.settle());
  EXPECT_EQ(rig.iris.blades(), 30);
  EXPECT_EQ(rig.iris.violations(), 0);
}

TEST(IrisMotor, AReleaseStopsItWithinAStep) {
  MotorRig rig(settings(0), {});
  ASSERT_TRUE(rig.go(10));
  rig.ask(40);
  ASSERT_TRUE(rig.run_until([&] { return rig.iris.blades() == 20 && rig.iris.pins().step; }));
  rig.ask(std::nullopt);
  rig.tick(milliseconds(1));
  EXPECT_FALSE(rig.iris.pins().override_auto);
  EXPECT_TRUE(rig.iris.pins().step);  // the step is not cut short
  rig.tick();
  rig.tick();
  EXPECT_FALSE(rig.iris.pins().step);
  EXPECT_FALSE(rig.iris.pins().enable);  // the lens is not held against its own control
  ASSERT_TRUE(rig.settle());
  EXPECT_EQ(rig.iris.blades(), 20);
  EXPECT_EQ(rig.motor.phase(), MotorPhase::released);
  EXPECT_EQ(rig.iris.violations(), 0);
}

TEST(IrisMotor, AReleaseDuringHomingLeavesItUnhomed) {
  MotorRig rig(settings(0), {.start = 30});
  rig.ask(20);
  ASSERT_TRUE(rig.run_until([&] { return rig.iris.blades() == 25; }));
  rig.ask(std::nullopt);
  ASSERT_TRUE(rig.settle());
  EXPECT_EQ(rig.iris.blades(), 25);
  ASSERT_TRUE(rig.go(20));
  EXPECT_EQ(rig.iris.blades(), 20);
}

TEST(IrisMotor, OverridesTheAutoIrisFromTheFirstRequestOn) {
  MotorRig rig(settings(0), {});
  rig.ask(20);
  rig.tick();
  EXPECT_TRUE(rig.iris.pins().override_auto);
  ASSERT_TRUE(rig.settle());
  for (int i = 0; i < 1000; ++i) rig.tick();
  EXPECT_TRUE(rig.iris.pins().override_auto);
}

TEST(IrisMotor, HoldsItsCurrentForAWhileAndThenLetsGo) {
  MotorRig rig(settings(0), {});
  rig.ask(20);
  ASSERT_TRUE(rig.run_until([&] { return rig.motor.phase() == MotorPhase::at_rest; }));
  EXPECT_TRUE(rig.iris.pins().enable);
  rig.tick(milliseconds(50));
  EXPECT_TRUE(rig.iris.pins().enable);
  rig.tick(milliseconds(100));
  EXPECT_FALSE(rig.iris.pins().enable);
}

TEST(IrisMotor, StepsOnceAStepPeriodWhenItIsCalledInTime) {
  MotorRig rig(settings(0), {});
  ASSERT_TRUE(rig.go(10));
  rig.ask(40);
  rig.tick();  // lines set up
  const Time start = rig.now;
  ASSERT_TRUE(rig.run_until([&] { return rig.iris.blades() == 40; }));
  EXPECT_EQ(rig.now - start, milliseconds(5 + 29 * 10));
}

TEST(IrisMotor, ALateCallMakesNoBurst) {
  MotorRig rig(settings(0), {});
  ASSERT_TRUE(rig.go(10));
  rig.ask(40);
  rig.tick();
  const std::uint64_t before = rig.iris.edges();
  rig.tick(milliseconds(1000));
  for (int i = 0; i < 9; ++i) rig.tick(milliseconds(1));
  EXPECT_EQ(rig.iris.edges() - before, 1U);
  EXPECT_EQ(rig.iris.violations(), 0);
}

TEST(IrisMotor, LosingItsLinesIsAFaultWhileItIsInCharge) {
  MotorRig rig(settings(0), {});
  rig.motor.lose();
  EXPECT_EQ(rig.motor.phase(), MotorPhase::released);
  ASSERT_TRUE(rig.go(10));
  rig.motor.lose();
  EXPECT_EQ(rig.motor.phase(), MotorPhase::faulty);
}

// Wherever it is sent, however often it changes its mind and however unevenly it is called.
class RandomMoves : public testing::TestWithParam<int> {};

TEST_P(RandomMoves, EndExactlyWhereTheyWereToEnd) {
  const int play = GetParam();
  std::mt19937 random(static_cast<unsigned>(7 + play));
  const auto up_to = [&](int last) { return std::uniform_int_distribution<int>(0, last)(random); };
  MotorRig rig(settings(play), {.play = play, .start = up_to(40)});
  int settled = 0;
  for (int move = 0; move < 400; ++move) {
    rig.ask(up_to(40));
    const int calls = up_to(3) == 0 ? 2000 : 1 + up_to(60);
    for (int i = 0; i < calls; ++i) rig.tick(std::chrono::microseconds(1000 + up_to(9000)));
    if (!rig.motor.idle()) continue;
    ++settled;
    ASSERT_EQ(rig.iris.blades(), rig.request.target_steps) << "move " << move;
  }
  EXPECT_GT(settled, 50);
  EXPECT_EQ(rig.iris.violations(), 0);
  EXPECT_EQ(rig.motor.steps(), rig.iris.edges());
}

INSTANTIATE_TEST_SUITE_P(Play, RandomMoves, testing::Values(0, 1, 5));

}  // namespace
}  // namespace dottrack::test
