#include "drivers/libgpiod/gpio_output_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "tests/support/memory_line_banks.h"

namespace dottrack::test {
namespace {

using drivers::GpioOutputLine;
using testing::AllOf;
using testing::HasSubstr;

TEST(GpioOutputLine, IsInactiveFromTheStartAndAfterItsEnd) {
  MemoryLineBanks banks;
  MemoryChip& chip = banks.add("lamps", 4);
  {
    const auto line = GpioOutputLine::open({"lamps", 2}, "lamp", banks);
    ASSERT_TRUE(line);
    EXPECT_FALSE(chip.levels.at(2));
    EXPECT_TRUE((*line)->set(true));
    EXPECT_TRUE(chip.levels.at(2));
  }
  EXPECT_FALSE(chip.levels.at(2));
  EXPECT_TRUE(chip.taken.empty());
}

TEST(GpioOutputLine, ActiveCanBeLow) {
  MemoryLineBanks banks;
  MemoryChip& chip = banks.add("lamps", 4);
  auto line = *GpioOutputLine::open({"/dev/gpiochip0", 1, true}, "lamp", banks);
  EXPECT_TRUE(chip.levels.at(1));
  line->set(true);
  EXPECT_FALSE(chip.levels.at(1));
  line.reset();
  EXPECT_TRUE(chip.levels.at(1));
}

TEST(GpioOutputLine, SaysWhenItCannotBeDriven) {
  MemoryLineBanks banks;
  MemoryChip& chip = banks.add("lamps", 4);
  const auto line = *GpioOutputLine::open({"lamps", 1}, "lamp", banks);
  chip.broken = true;
  EXPECT_FALSE(line->set(true));
}

TEST(GpioOutputLine, LeavesTheHeapAlone) {
  MemoryLineBanks banks;
  banks.add("lamps", 4);
  const auto line = *GpioOutputLine::open({"lamps", 1}, "lamp", banks);
  const rtos::AllocationTrap::Scope armed;
  line->set(true);
  EXPECT_EQ(armed.calls().total(), 0U);
}

TEST(GpioOutputLine, RefusesWhatIsNotThereOrTaken) {
  MemoryLineBanks banks;
  banks.add("lamps", 4);
  const auto refusal = [&](const drivers::GpioLine& line) {
    const auto opened = GpioOutputLine::open(line, "dottrack trigger", banks);
    return opened ? "" : opened.error().message;
  };
  EXPECT_THAT(refusal({"lumps", 1}), AllOf(HasSubstr("dottrack trigger"), HasSubstr("lumps")));
  EXPECT_THAT(refusal({"lamps", 4}), AllOf(HasSubstr("line 4"), HasSubstr("expected 0 to 3")));
  const auto first = *GpioOutputLine::open({"lamps", 1}, "lamp", banks);
  EXPECT_THAT(refusal({"lamps", 1}), AllOf(HasSubstr("line 1"), HasSubstr("in use")));
}

// With the machine's own chips, however many it has.
TEST(GpioOutputLine, AChipThatTheMachineDoesNotHaveIsAnError) {
  const auto line = GpioOutputLine::open({"no such chip", 0}, "lamp");
  ASSERT_FALSE(line);
  EXPECT_THAT(line.error().message, HasSubstr("no such chip"));
  const auto path = GpioOutputLine::open({"/dev/no-such-chip", 0}, "lamp");
  ASSERT_FALSE(path);
  EXPECT_THAT(path.error().message, HasSubstr("/dev/no-such-chip"));
  const auto no_chip = GpioOutputLine::open({"/dev/null", 0}, "lamp");
  ASSERT_FALSE(no_chip);
  EXPECT_THAT(no_chip.error().message, HasSubstr("/dev/null"));
}

}  // namespace
}  // namespace dottrack::test
