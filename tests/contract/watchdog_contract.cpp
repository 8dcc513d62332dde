#include "tests/contract/watchdog_contract.h"

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

constexpr Duration kTimeout = WatchdogBench::kTimeout;

TEST_P(WatchdogContract, KnowsItsTimeout) {
  EXPECT_EQ(watchdog_.timeout(), kTimeout);
}

TEST_P(WatchdogContract, StaysQuietWhileItIsKickedInTime) {
  for (int n = 0; n < 10; ++n) {
    bench_->spend(kTimeout * 3 / 4);
    watchdog_.kick();
  }
  bench_->spend(kTimeout * 3 / 4);
  EXPECT_FALSE(bench_->bitten());
}

TEST_P(WatchdogContract, BitesWhenTheKicksCease) {
  watchdog_.kick();
  bench_->spend(kTimeout + Duration(1));
  EXPECT_TRUE(bench_->bitten());
}

TEST_P(WatchdogContract, IsArmedBeforeTheFirstKick) {
  bench_->spend(kTimeout + Duration(1));
  EXPECT_TRUE(bench_->bitten());
}

TEST_P(WatchdogContract, AKickThatComesTooLateDoesNotHelp) {
  bench_->spend(kTimeout + Duration(1));
  watchdog_.kick();
  bench_->spend(Duration(1));
  EXPECT_TRUE(bench_->bitten());
}

// More of them than any pipe or socket holds.
TEST_P(WatchdogContract, KicksThatNobodyTakesDoNotBlock) {
  for (int n = 0; n < 100000; ++n) watchdog_.kick();
  bench_->spend(kTimeout / 2);
  EXPECT_FALSE(bench_->bitten());
}

TEST_P(WatchdogContract, LeavesTheHeapAlone) {
  const rtos::AllocationTrap::Scope armed;
  for (int n = 0; n < 3; ++n) watchdog_.kick();
  watchdog_.timeout();
  EXPECT_EQ(armed.calls().total(), 0U);
}

}  // namespace
}  // namespace dottrack::test
