#include "drivers/libgpiod/gpio_iris.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/memory_line_banks.h"
#include "tests/unit/drivers/libgpiod/mechanical_iris.h"

namespace dottrack::test {
namespace {

using drivers::GpioIris;
using drivers::IrisWiring;
using testing::AllOf;
using testing::HasSubstr;

// Lines base to base + 4 of a chip: step, direction, enable, auto, end stop.
IrisWiring wiring(const std::string& name, const std::string& chip, unsigned base) {
  return {.name = name,
          .chip = chip,
          .step_line = base,
          .direction_line = base + 1,
          .enable_line = base + 2,
          .auto_line = base + 3,
          .end_stop_line = base + 4,
          .travel_steps = 40,
          .backlash_steps = 2};
}

class GpioIrises : public testing::Test {
 protected:
  // Cameras 0 and 2 on one chip, camera 3 on another; camera 1 has no iris.
  void open() {
    irises_ = *GpioIris::open({wiring("cam0", "steppers", 0), std::nullopt,
                               wiring("cam2", "steppers", 8), wiring("cam3", "/dev/gpiochip1", 0)},
                              clock_, banks_);
  }

  void tick() {
    clock_.jump_to(clock_.now() + irises_->step_period());
    irises_->advance(clock_.now());
    turn(near_, steppers_, 0);
    turn(far_, steppers_, 8);
    turn(other_, others_, 0);
  }

  void turn(MechanicalIris& iris, MemoryChip& chip, unsigned base) {
    const auto level = [&](unsigned line) { return chip.levels.at(base + line); };
    iris.drive({level(0), level(1), level(2), level(3)}, clock_.now());
    chip.levels.at(base + 4) = iris.end_stop();
  }

  bool settle() {
    for (int i = 0; i < 1000; ++i) {
      bool moving = false;
      for (std::size_t camera = 0; camera < 4; ++camera) {
        moving = moving || irises_->state(camera).moving;
      }
      if (!moving) return true;
      tick();
    }
    return false;
  }

  rtos::VirtualClock clock_;
  MemoryLineBanks banks_;
  MemoryChip& steppers_ = banks_.add("steppers", 16);
  MemoryChip& others_ = banks_.add("others", 8);
  MechanicalIris near_{{.play = 2, .start = 30}};
  MechanicalIris far_{{.play = 2, .start = 3}};
  MechanicalIris other_{{.play = 2, .start = -1}};
  std::unique_ptr<GpioIris> irises_;
};

TEST_F(GpioIrises, AllGoWhereTheyAreSent) {
  open();
  EXPECT_TRUE(irises_->move_to(0, 0.25));
  EXPECT_TRUE(irises_->move_to(2, 1.0));
  EXPECT_TRUE(irises_->move_to(3, 0.5));
  ASSERT_TRUE(settle());
  EXPECT_EQ(near_.blades(), 10);
  EXPECT_EQ(far_.blades(), 40);
  EXPECT_EQ(other_.blades(), 20);
  EXPECT_DOUBLE_EQ(irises_->state(0).opening, 0.25);
  EXPECT_TRUE(irises_->state(0).healthy);
  for (const MechanicalIris* iris : {&near_, &far_, &other_}) EXPECT_EQ(iris->violations(), 0);
  EXPECT_EQ(irises_->steps(0), near_.edges());
  EXPECT_EQ(irises_->steps(2), far_.edges());
  EXPECT_EQ(irises_->steps(3), other_.edges());
}

TEST_F(GpioIrises, ACameraWithoutAnIrisTakesNoRequestAndIsWell) {
  open();
  for (const std::size_t camera : {1U, 4U, 99U}) {
    EXPECT_FALSE(irises_->move_to(camera, 0.5));
    EXPECT_FALSE(irises_->release_to_auto(camera));
    EXPECT_TRUE(irises_->state(camera).healthy);
    EXPECT_TRUE(irises_->state(camera).automatic);
    EXPECT_EQ(irises_->steps(camera), 0U);
  }
}

TEST_F(GpioIrises, AnOpeningThatIsNoNumberIsRefused) {
  open();
  EXPECT_FALSE(irises_->move_to(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(irises_->state(0).automatic);
}

TEST_F(GpioIrises, SoftLimitsHoldWhateverIsAsked) {
  IrisWiring limited = wiring("cam0", "steppers", 0);
  limited.limits = {0.25, 0.75};
  irises_ = *GpioIris::open({limited}, clock_, banks_);
  ASSERT_TRUE(irises_->move_to(0, 5.0));
  ASSERT_TRUE(settle());
  EXPECT_EQ(near_.blades(), 30);
  ASSERT_TRUE(irises_->move_to(0, -1.0));
  ASSERT_TRUE(settle());
  EXPECT_EQ(near_.blades(), 10);
}

TEST_F(GpioIrises, WritesAndReadsEachChipOnceACallAtMost) {
  open();
  irises_->move_to(0, 0.25);
  irises_->move_to(2, 0.75);
  for (int i = 0; i < 200; ++i) {
    const int writes = steppers_.writes;
    const int reads = steppers_.reads;
    tick();
    ASSERT_LE(steppers_.writes - writes, 1);
    ASSERT_LE(steppers_.reads - reads, 1);
  }
  EXPECT_EQ(others_.writes + others_.reads, 0);
}

TEST_F(GpioIrises, LeavesTheLinesAloneWhenNothingMoves) {
  open();
  irises_->move_to(0, 0.25);
  ASSERT_TRUE(settle());
  for (int i = 0; i < 40; ++i) tick();  // until the current is off
  const int calls = steppers_.writes + steppers_.reads;
  irises_->move_to(0, 0.25);  // where it is
  EXPECT_FALSE(irises_->state(0).moving);
  for (int i = 0; i < 10; ++i) tick();
  EXPECT_EQ(steppers_.writes + steppers_.reads, calls);
}

TEST_F(GpioIrises, ARequestShowsBeforeItIsBegun) {
  open();
  irises_->move_to(0, 0.25);
  EXPECT_TRUE(irises_->state(0).moving);
  EXPECT_FALSE(irises_->state(0).automatic);
  irises_->release_to_auto(0);
  EXPECT_FALSE(irises_->state(0).moving);
  EXPECT_TRUE(irises_->state(0).automatic);
}

TEST_F(GpioIrises, TheNewestRequestWins) {
  open();
  irises_->move_to(0, 0.25);
  irises_->move_to(0, 0.75);
  irises_->release_to_auto(0);
  irises_->move_to(0, 0.5);
  ASSERT_TRUE(settle());
  EXPECT_EQ(near_.blades(), 20);
}

TEST_F(GpioIrises, AStopThatIsNeverFoundMakesThatIrisUnhealthy) {
  near_.break_switch(false);
  open();
  irises_->move_to(0, 0.25);
  irises_->move_to(2, 0.25);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(irises_->state(0).healthy);
  EXPECT_TRUE(irises_->state(2).healthy);
  EXPECT_EQ(far_.blades(), 10);
}

TEST_F(GpioIrises, ABrokenChipMakesItsIrisesUnhealthyAndARetryHealsThem) {
  open();
  irises_->move_to(0, 0.25);
  irises_->move_to(3, 0.25);
  for (int i = 0; i < 5; ++i) tick();
  steppers_.broken = true;
  ASSERT_TRUE(settle());
  EXPECT_FALSE(irises_->state(0).healthy);
  EXPECT_TRUE(irises_->state(3).healthy);
  EXPECT_EQ(other_.blades(), 10);

  steppers_.broken = false;
  irises_->release_to_auto(0);
  irises_->move_to(0, 0.5);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(irises_->state(0).healthy);
  EXPECT_EQ(near_.blades(), 20);
}

TEST_F(GpioIrises, TheirEndGivesTheLensesBack) {
  open();
  for (const std::size_t camera : {0U, 2U, 3U}) irises_->move_to(camera, 0.6);
  for (int i = 0; i < 7; ++i) tick();
  EXPECT_TRUE(steppers_.levels.at(2));
  EXPECT_TRUE(steppers_.levels.at(3));
  irises_.reset();
  for (const unsigned line : {0U, 2U, 3U, 8U, 10U, 11U}) {
    EXPECT_FALSE(steppers_.levels.at(line)) << line;
  }
  EXPECT_FALSE(others_.levels.at(3));
  EXPECT_TRUE(steppers_.taken.empty());
}

TEST_F(GpioIrises, NothingAllocatesAfterOpen) {
  open();
  const rtos::AllocationTrap::Scope armed;
  irises_->move_to(0, 0.25);
  irises_->move_to(3, 0.75);
  const bool settled = settle();
  irises_->release_to_auto(0);
  tick();
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_TRUE(settled);
}

TEST_F(GpioIrises, TheFastestIrisSetsThePace) {
  IrisWiring fast = wiring("cam0", "steppers", 0);
  fast.steps_per_s = 500.0;
  irises_ = *GpioIris::open({fast, wiring("cam1", "steppers", 8)}, clock_, banks_);
  EXPECT_GE(irises_->step_period(), std::chrono::microseconds(1000));
  EXPECT_LE(irises_->step_period(), std::chrono::microseconds(1030));
}

TEST_F(GpioIrises, NoIrisesAtAllIsNoError) {
  const auto none = GpioIris::open({std::nullopt}, clock_, banks_);
  ASSERT_TRUE(none);
  EXPECT_GT((*none)->step_period(), Duration::zero());
}

class GpioIrisRefusals : public GpioIrises {
 protected:
  std::string refusal(const std::vector<std::optional<IrisWiring>>& irises) {
    const auto opened = GpioIris::open(irises, clock_, banks_);
    return opened ? "" : opened.error().message;
  }
};

TEST_F(GpioIrisRefusals, AChipThatIsNotThere) {
  EXPECT_THAT(refusal({wiring("cam0", "nowhere", 5)}),
              AllOf(HasSubstr("cam0"), HasSubstr("line 5"), HasSubstr("nowhere")));
}

TEST_F(GpioIrisRefusals, ALineThatTheChipDoesNotHave) {
  EXPECT_THAT(
      refusal({wiring("cam0", "others", 4)}),
      AllOf(HasSubstr("cam0: end stop line 8 of GPIO chip others"), HasSubstr("expected 0 to 7")));
}

TEST_F(GpioIrisRefusals, ALineWithTwoUsesWhateverItsChipIsCalled) {
  EXPECT_THAT(refusal({wiring("cam0", "steppers", 0), wiring("cam1", "/dev/gpiochip0", 4)}),
              AllOf(HasSubstr("line 4 of GPIO chip steppers"), HasSubstr("cam0: end stop"),
                    HasSubstr("cam1: step")));
}

TEST_F(GpioIrisRefusals, ALineThatSomebodyElseUses) {
  steppers_.users[3] = "leds";
  EXPECT_THAT(refusal({wiring("cam0", "steppers", 0)}),
              AllOf(HasSubstr("cam0: auto line 3 of GPIO chip steppers"), HasSubstr("leds")));
}

TEST_F(GpioIrisRefusals, WiringThatMakesNoSense) {
  IrisWiring iris = wiring("cam0", "steppers", 0);
  iris.travel_steps = 0;
  EXPECT_THAT(refusal({iris}), AllOf(HasSubstr("cam0"), HasSubstr("travel")));
  iris = wiring("cam0", "steppers", 0);
  iris.steps_per_s = 0.0;
  EXPECT_THAT(refusal({iris}), HasSubstr("steps a second"));
  iris = wiring("cam0", "steppers", 0);
  iris.backlash_steps = -1;
  EXPECT_THAT(refusal({iris}), HasSubstr("backlash"));
  iris = wiring("cam0", "steppers", 0);
  iris.limits = {0.8, 0.2};
  EXPECT_THAT(refusal({iris}), HasSubstr("limits"));
}

}  // namespace
}  // namespace dottrack::test
