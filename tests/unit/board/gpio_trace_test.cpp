#include "tests/board/harness/gpio_trace.h"

#include <gtest/gtest.h>

namespace dottrack::board {
namespace {

TEST(GpioTrace, GivesTimeLineAndLevelOfAWrite) {
  const auto write =
      parse_gpio_write("   dottrack-loop-325     [000] .....    97.892424: gpio_value: 444 set 1");
  ASSERT_TRUE(write);
  EXPECT_EQ(write->gpio, 444U);
  EXPECT_TRUE(write->high);
  EXPECT_EQ(write->at.time_since_epoch(), std::chrono::microseconds(97'892'424));
}

TEST(GpioTrace, AProcessNameMayHoldSpaces) {
  const auto write =
      parse_gpio_write("  a name: 1 set-7 [001] d..1.  1.000001: gpio_value: 5 set 0");
  ASSERT_TRUE(write);
  EXPECT_EQ(write->gpio, 5U);
  EXPECT_FALSE(write->high);
}

TEST(GpioTrace, ReadsAndOtherEventsAreNoWrites) {
  for (const char* line :
       {"", "x-1 [000] ..... 1.5: gpio_value: 444 get 1", "x-1 [000] ..... 1.5: gpio_value: set 1",
        "x-1 [000] ..... 1.5: gpio_direction: 444 out (0)", "x-1 ..... now: gpio_value: 444 set 1",
        "CPU:1 [LOST 12 EVENTS]"}) {
    EXPECT_FALSE(parse_gpio_write(line)) << line;
  }
}

TEST(GpioTrace, TellsTheChipsFirstLine) {
  EXPECT_EQ(parse_gpio_base("sh-200 [001] ..... 12.25: tracing_mark_write: gpio-base 448"), 448U);
  EXPECT_FALSE(parse_gpio_base("sh-200 [001] ..... 12.25: tracing_mark_write: something"));
}

TEST(GpioTrace, TellsOfLostEvents) {
  EXPECT_TRUE(tells_of_lost_events("CPU:1 [LOST 12 EVENTS]"));
  EXPECT_FALSE(tells_of_lost_events("x-1 [000] ..... 1.5: gpio_value: 444 set 1"));
}

}  // namespace
}  // namespace dottrack::board
