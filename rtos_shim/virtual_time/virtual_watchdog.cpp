#include "rtos_shim/virtual_time/virtual_watchdog.h"

#include <cassert>

namespace dottrack::rtos {

VirtualWatchdog::VirtualWatchdog(const VirtualClock& clock, Duration timeout)
    : clock_(clock), timeout_(timeout), last_kick_(clock.now()) {
  assert(timeout > Duration::zero());
}

std::optional<Time> VirtualWatchdog::bitten_at() const {
  if (clock_.now() - last_kick_ <= timeout_) return std::nullopt;
  return last_kick_ + timeout_;
}

void VirtualWatchdog::do_kick() {
  if (!bitten()) last_kick_ = clock_.now();
}

}  // namespace dottrack::rtos
