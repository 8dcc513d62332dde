#include <gtest/gtest.h>

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"
#include "rtos_shim/virtual_time/virtual_watchdog.h"

namespace dottrack::rtos {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

Time at(Duration since_start) {
  return Time(since_start);
}

TEST(VirtualClock, StandsStillUntilItIsMoved) {
  VirtualClock clock(at(milliseconds(5)));
  EXPECT_EQ(clock.now(), at(milliseconds(5)));
  EXPECT_EQ(clock.now(), at(milliseconds(5)));
  clock.jump_to(at(hours(1000)));
  EXPECT_EQ(clock.now(), at(hours(1000)));
}

TEST(VirtualClock, NeverGoesBack) {
  VirtualClock clock(at(milliseconds(5)));
  clock.jump_to(at(milliseconds(3)));
  EXPECT_EQ(clock.now(), at(milliseconds(5)));
}

TEST(VirtualPeriodicTimer, WaitingIsAJumpToTheNextInstant) {
  VirtualClock clock;
  VirtualPeriodicTimer timer(clock, at(hours(1)), hours(1));
  for (int n = 1; n <= 3; ++n) {
    const Wake wake = timer.wait();
    EXPECT_EQ(wake.due, at(hours(n)));
    EXPECT_EQ(wake.missed, 0U);
    EXPECT_EQ(clock.now(), at(hours(n)));
  }
}

TEST(VirtualPeriodicTimer, ATickThatOverrunsCostsTheInstantsItCoveredAndNotTheGrid) {
  VirtualClock clock;
  VirtualPeriodicTimer timer(clock, at(milliseconds(0)), milliseconds(10));
  timer.wait();
  clock.jump_to(at(milliseconds(34)));  // over the instants 10, 20 and 30
  const Wake late = timer.wait();
  EXPECT_EQ(late.missed, 3U);
  EXPECT_EQ(late.due, at(milliseconds(40)));
  EXPECT_EQ(timer.wait().missed, 0U);
}

TEST(VirtualPeriodicTimer, AnInstantThatIsDueRightNowIsNotMissed) {
  VirtualClock clock;
  VirtualPeriodicTimer timer(clock, at(milliseconds(0)), milliseconds(10));
  timer.wait();
  clock.jump_to(at(milliseconds(20)));  // over 10; 20 is now
  const Wake wake = timer.wait();
  EXPECT_EQ(wake.missed, 1U);
  EXPECT_EQ(wake.due, at(milliseconds(20)));
}

TEST(VirtualWatchdog, RemembersWhenItBitFirst) {
  VirtualClock clock;
  VirtualWatchdog watchdog(clock, milliseconds(100));
  clock.jump_to(at(milliseconds(50)));
  watchdog.kick();
  clock.jump_to(at(milliseconds(150)));
  EXPECT_EQ(watchdog.bitten_at(), std::nullopt);
  clock.jump_to(at(hours(1)));
  watchdog.kick();
  clock.jump_to(at(hours(2)));
  EXPECT_EQ(watchdog.bitten_at(), at(milliseconds(150)));
}

}  // namespace
}  // namespace dottrack::rtos
