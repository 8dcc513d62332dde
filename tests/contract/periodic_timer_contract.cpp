#include "tests/contract/periodic_timer_contract.h"

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

TEST_P(PeriodicTimerContract, EveryWakeUpBelongsToAnInstantOfTheGrid) {
  for (int n = 0; n < 20; ++n) {
    const rtos::Wake wake = timer_.wait();
    EXPECT_EQ((wake.due - bench_->start()) % TimerBench::kPeriod, Duration(0));
    bench_->spend(TimerBench::kPeriod / 5);
  }
}

TEST_P(PeriodicTimerContract, NoWakeUpComesBeforeItsInstant) {
  for (int n = 0; n < 20; ++n) {
    const rtos::Wake wake = timer_.wait();
    EXPECT_GE(bench_->clock().now(), wake.due);
  }
}

TEST_P(PeriodicTimerContract, EveryInstantIsEitherAttendedOrCountedAsMissed) {
  Time last = timer_.wait().due;
  for (int n = 0; n < 8; ++n) {
    bench_->spend(n * TimerBench::kPeriod / 2);
    const rtos::Wake wake = timer_.wait();
    EXPECT_EQ(wake.due - last, static_cast<Duration::rep>(wake.missed + 1) * TimerBench::kPeriod);
    last = wake.due;
  }
}

TEST_P(PeriodicTimerContract, ALongTickIsCounted) {
  timer_.wait();
  bench_->spend(TimerBench::kPeriod * 7 / 2);
  EXPECT_GE(timer_.wait().missed, 3U);
}

TEST_P(PeriodicTimerContract, KnowsItsPeriod) {
  EXPECT_EQ(timer_.period(), TimerBench::kPeriod);
}

TEST_P(PeriodicTimerContract, LeavesTheHeapAlone) {
  const rtos::AllocationTrap::Scope armed;
  for (int n = 0; n < 3; ++n) timer_.wait();
  EXPECT_EQ(armed.calls().total(), 0U);
}

}  // namespace
}  // namespace dottrack::test
