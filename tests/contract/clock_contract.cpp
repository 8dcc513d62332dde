#include "tests/contract/clock_contract.h"

#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::test {
namespace {

TEST_P(ClockContract, NeverGoesBack) {
  Time last = clock_->now();
  for (int i = 0; i < 10000; ++i) {
    const Time now = clock_->now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST_P(ClockContract, LeavesTheHeapAlone) {
  const rtos::AllocationTrap::Scope armed;
  clock_->now();
  EXPECT_EQ(armed.calls().total(), 0U);
}

}  // namespace
}  // namespace dottrack::test
