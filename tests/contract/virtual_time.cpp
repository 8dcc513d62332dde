#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"
#include "rtos_shim/virtual_time/virtual_watchdog.h"
#include "tests/contract/clock_contract.h"
#include "tests/contract/periodic_timer_contract.h"
#include "tests/contract/watchdog_contract.h"

namespace dottrack::test {
namespace {

class VirtualBench final : public TimerBench {
 public:
  rtos::PeriodicTimer& timer() override { return timer_; }
  const rtos::Clock& clock() const override { return clock_; }
  Time start() const override { return Time(std::chrono::seconds(3)); }
  void spend(Duration time) override { clock_.jump_to(clock_.now() + time); }

 private:
  rtos::VirtualClock clock_;
  rtos::VirtualPeriodicTimer timer_{clock_, start(), kPeriod};
};

class VirtualWatchdogBench final : public WatchdogBench {
 public:
  rtos::Watchdog& watchdog() override { return watchdog_; }
  void spend(Duration time) override { clock_.jump_to(clock_.now() + time); }
  bool bitten() const override { return watchdog_.bitten(); }

 private:
  rtos::VirtualClock clock_;
  rtos::VirtualWatchdog watchdog_{clock_, kTimeout};
};

INSTANTIATE_TEST_SUITE_P(Virtual, ClockContract,
                         testing::Values(ClockCase{
                             "clock", [] { return std::make_unique<rtos::VirtualClock>(); }}));

INSTANTIATE_TEST_SUITE_P(Virtual, PeriodicTimerContract,
                         testing::Values(TimerCase{
                             "timer", [] { return std::make_unique<VirtualBench>(); }}));

INSTANTIATE_TEST_SUITE_P(Virtual, WatchdogContract,
                         testing::Values(WatchdogCase{
                             "watchdog", [] { return std::make_unique<VirtualWatchdogBench>(); }}));

}  // namespace
}  // namespace dottrack::test
