// Lines of the kernel's GPIO simulator: whoever runs the board makes a chip labelled dottrack-test
// with 64 lines.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/libgpiod/gpio_iris.h"
#include "drivers/libgpiod/gpio_output_line.h"
#include "drivers/libgpiod/line_bank.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "tests/support/gpio_sim_chip.h"
#include "tests/unit/drivers/libgpiod/mechanical_iris.h"

namespace dottrack::test {
namespace {

using drivers::BankRequest;
using drivers::GpioIris;
using drivers::GpioOutputLine;
using drivers::IrisWiring;
using drivers::LineBank;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kLabel = "dottrack-test";
constexpr unsigned kOutputs = 60;
constexpr unsigned kInputs = 4;  // after the outputs
constexpr std::uint64_t kAll = (std::uint64_t{1} << kOutputs) - 1;

class GpioOnBoard : public testing::Test {
 protected:
  void SetUp() override {
    found_ = GpioSimChip::find(kLabel);
    if (!found_) GTEST_SKIP() << "no simulated GPIO chip labelled " << kLabel;
    ASSERT_EQ(chip().chip().lines, kOutputs + kInputs);
    for (unsigned i = 0; i < kOutputs + kInputs; ++i) {
      if (!chip().pull(i, false)) GTEST_SKIP() << "no permission to pull simulated GPIO lines";
    }
  }

  const GpioSimChip& chip() const { return *found_; }

  // Every third output is active low.
  static bool active_low(unsigned line) { return line % 3 == 2; }
  BankRequest request() const {
    BankRequest lines{chip().chip(), "dottrack bank", {}, {}};
    for (unsigned i = 0; i < kOutputs; ++i) {
      lines.outputs.push_back({i, active_low(i), false, "output"});
    }
    for (unsigned i = 0; i < kInputs; ++i) {
      lines.inputs.push_back({kOutputs + i, i == 3, false, "input"});
    }
    return lines;
  }

  std::uint64_t active_outputs() const {
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < kOutputs; ++i) {
      bits |= std::uint64_t{chip().level(i) != active_low(i)} << i;
    }
    return bits;
  }

  std::optional<GpioSimChip> found_;
};

TEST_F(GpioOnBoard, AnOutputLineIsWhatItIsSetTo) {
  auto line = GpioOutputLine::open({kLabel, 7}, "dottrack trigger");
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_FALSE(chip().level(7));
  EXPECT_TRUE((*line)->set(true));
  EXPECT_TRUE(chip().level(7));
  EXPECT_TRUE((*line)->set(false));
  EXPECT_FALSE(chip().level(7));
  (*line)->set(true);
  line->reset();
  EXPECT_FALSE(chip().level(7));
}

TEST_F(GpioOnBoard, AnActiveLowLineIsHighWhenInactive) {
  const auto line = GpioOutputLine::open({chip().chip().path, 8, true}, "dottrack lamp");
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_TRUE(chip().level(8));
  EXPECT_TRUE((*line)->set(true));
  EXPECT_FALSE(chip().level(8));
}

TEST_F(GpioOnBoard, ALineInUseIsRefusedByName) {
  const auto first = GpioOutputLine::open({kLabel, 7}, "dottrack trigger");
  ASSERT_TRUE(first) << first.error().message;
  const auto second = GpioOutputLine::open({kLabel, 7}, "dottrack lamp");
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message,
              AllOf(HasSubstr("dottrack lamp"), HasSubstr("line 7"), HasSubstr(kLabel),
                    HasSubstr("in use by dottrack trigger")));
}

TEST_F(GpioOnBoard, ALineBeyondTheChipIsRefused) {
  const auto line = GpioOutputLine::open({kLabel, 64}, "dottrack lamp");
  ASSERT_FALSE(line);
  EXPECT_THAT(line.error().message, HasSubstr("expected 0 to 63"));
}

TEST_F(GpioOnBoard, OneCallSetsTheLinesOfTheMaskAndNoOther) {
  const auto bank = drivers::kernel_line_banks().request(request());
  ASSERT_TRUE(bank) << bank.error().message;
  EXPECT_EQ(active_outputs(), 0U);
  const std::uint64_t pattern = 0x0123'4567'89AB'CDEFU & kAll;
  EXPECT_TRUE((*bank)->set(kAll, pattern));
  EXPECT_EQ(active_outputs(), pattern);
  EXPECT_TRUE((*bank)->set(0xFF, ~pattern));
  EXPECT_EQ(active_outputs(), pattern ^ 0xFF);
}

TEST_F(GpioOnBoard, InputsAreWhatPullsThem) {
  const auto bank = drivers::kernel_line_banks().request(request());
  ASSERT_TRUE(bank) << bank.error().message;
  EXPECT_EQ((*bank)->inputs(), 0b1000U);  // the last is active low
  ASSERT_TRUE(chip().pull(kOutputs + 1, true));
  EXPECT_EQ((*bank)->inputs(), 0b1010U);
  ASSERT_TRUE(chip().pull(kOutputs + 3, true));
  EXPECT_EQ((*bank)->inputs(), 0b0010U);
}

TEST_F(GpioOnBoard, TheHeapIsLeftAlone) {
  const auto bank = drivers::kernel_line_banks().request(request());
  ASSERT_TRUE(bank) << bank.error().message;
  const rtos::AllocationTrap::Scope armed;
  bool driven = true;
  for (std::uint64_t i = 0; i < 100; ++i) {
    driven = (*bank)->set(kAll, i) && (*bank)->inputs().has_value() && driven;
  }
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_TRUE(driven);
}

// A mechanical iris on the simulated lines; its time is counted, not waited for.
class GpioIrisOnBoard : public GpioOnBoard {
 protected:
  struct StandingClock final : rtos::Clock {
    Time do_now() const override { return {}; }
  };

  void run_until_still(GpioIris& irises) {
    for (int i = 0; i < 2000 && irises.state(0).moving; ++i) {
      now_ += irises.step_period();
      irises.advance(now_);
      iris_.drive({chip().level(0), chip().level(1), chip().level(2), chip().level(3)}, now_);
      ASSERT_TRUE(chip().pull(kOutputs, iris_.end_stop()));
    }
  }

  const IrisWiring wiring_{.name = "cam1",
                           .chip = kLabel,
                           .step_line = 0,
                           .direction_line = 1,
                           .enable_line = 2,
                           .auto_line = 3,
                           .end_stop_line = kOutputs,
                           .travel_steps = 40,
                           .backlash_steps = 3};
  StandingClock clock_;
  MechanicalIris iris_{{.play = 3, .start = 23}};
  Time now_{};
};

TEST_F(GpioIrisOnBoard, HomesMovesAndIsGivenBack) {
  auto opened = GpioIris::open({wiring_}, clock_);
  ASSERT_TRUE(opened) << opened.error().message;
  GpioIris& irises = **opened;
  for (const double opening : {0.5, 0.25, 1.0}) {
    ASSERT_TRUE(irises.move_to(0, opening));
    run_until_still(irises);
    EXPECT_EQ(iris_.blades(), opening * 40);
    EXPECT_TRUE(irises.state(0).healthy);
  }
  EXPECT_EQ(iris_.violations(), 0);
  EXPECT_EQ(irises.steps(0), iris_.edges());
  EXPECT_TRUE(chip().level(3));
  opened->reset();
  EXPECT_FALSE(chip().level(3));
  EXPECT_FALSE(chip().level(2));
}

TEST_F(GpioIrisOnBoard, AnEndStopThatNeverComesIsSeen) {
  const auto opened = GpioIris::open({wiring_}, clock_);
  ASSERT_TRUE(opened) << opened.error().message;
  iris_.break_switch(false);
  ASSERT_TRUE((*opened)->move_to(0, 0.5));
  run_until_still(**opened);
  EXPECT_FALSE((*opened)->state(0).healthy);
}

}  // namespace
}  // namespace dottrack::test
