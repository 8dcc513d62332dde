#include "tests/board/harness/gpio_bench.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/board/harness/wiring.h"

namespace dottrack::board {
namespace {

constexpr unsigned kBase = 448;
constexpr unsigned kStep = 0;
constexpr unsigned kDirection = 1;
constexpr unsigned kEnable = 2;
constexpr unsigned kAuto = 3;

std::string base_line() {
  return fmt::format("sh-1 [000] ..... 1.0: tracing_mark_write: gpio-base {}", kBase);
}

std::string set(unsigned line, int level) {
  return fmt::format("x-1 [000] ..... 2.5: gpio_value: {} set {}", kBase + line, level);
}

void pulse(GpioBench& bench, unsigned line, int times) {
  for (int i = 0; i < times; ++i) {
    bench.take(set(line, 1));
    bench.take(set(line, 0));
  }
}

TEST(GpioBench, CountsTriggerPulsesNotWrites) {
  GpioBench bench(1);
  bench.take(base_line());
  pulse(bench, kTriggerLine, 3);
  bench.take(set(kTriggerLine, 0));
  bench.take(set(kTriggerLine, 1));
  bench.take(set(kTriggerLine, 1));
  ASSERT_EQ(bench.trigger_pulses().size(), 4U);
  EXPECT_EQ(bench.trigger_pulses()[0].time_since_epoch(), std::chrono::microseconds(2'500'000));
}

TEST(GpioBench, WhatCameBeforeTheBaseWasToldCountsToo) {
  GpioBench bench(1);
  pulse(bench, kTriggerLine, 2);
  EXPECT_TRUE(bench.trigger_pulses().empty());
  bench.take(base_line());
  EXPECT_EQ(bench.trigger_pulses().size(), 2U);
}

TEST(GpioBench, OtherChipsAreNothingToIt) {
  GpioBench bench(1);
  bench.take(base_line());
  bench.take(set(kGpioLines, 1));
  bench.take(fmt::format("x-1 [000] ..... 2.5: gpio_value: {} set 1", kTriggerLine));
  EXPECT_TRUE(bench.trigger_pulses().empty());
}

TEST(GpioBench, AnIrisHomesAndOpens) {
  GpioBench bench(2);
  bench.take(base_line());
  const unsigned first = kLinesPerIris;  // of the second iris
  bench.take(set(first + kAuto, 1));
  bench.take(set(first + kEnable, 1));
  pulse(bench, first + kStep, kIrisTravel_steps + kIrisBacklash_steps);
  EXPECT_TRUE(bench.iris(1).was_closed());
  EXPECT_EQ(bench.iris(1).blades_steps(), 0);
  bench.take(set(first + kDirection, 1));
  pulse(bench, first + kStep, kIrisOpening_steps + kIrisBacklash_steps);
  EXPECT_EQ(bench.iris(1).blades_steps(), kIrisOpening_steps);
  EXPECT_TRUE(bench.iris(1).overridden());
  EXPECT_FALSE(bench.iris(0).overridden());
  EXPECT_EQ(bench.iris(0).steps(), 0U);
}

TEST(GpioBench, AMotorWithoutCurrentDoesNotTurn) {
  GpioBench bench(1);
  bench.take(base_line());
  const int before = bench.iris(0).blades_steps();
  pulse(bench, kStep, 10);
  EXPECT_EQ(bench.iris(0).blades_steps(), before);
  EXPECT_EQ(bench.iris(0).idle_steps(), 10U);
}

TEST(GpioBench, AResetLeavesTheBladesAndTheCountsOfSteps) {
  GpioBench bench(1);
  bench.take(base_line());
  bench.take(set(kEnable, 1));
  pulse(bench, kStep, 10);
  pulse(bench, kTriggerLine, 1);
  const int blades = bench.iris(0).blades_steps();
  bench.start_boot();
  EXPECT_EQ(bench.iris(0).blades_steps(), blades);
  EXPECT_FALSE(bench.iris(0).enabled());
  EXPECT_TRUE(bench.trigger_pulses().empty());
}

TEST(GpioBench, ALossIsRemembered) {
  GpioBench bench(1);
  EXPECT_TRUE(bench.complete());
  bench.take("CPU:0 [LOST 3 EVENTS]");
  EXPECT_FALSE(bench.complete());
}

}  // namespace
}  // namespace dottrack::board
