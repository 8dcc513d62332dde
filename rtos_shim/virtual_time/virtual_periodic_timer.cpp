#include "rtos_shim/virtual_time/virtual_periodic_timer.h"

#include <cassert>

namespace dottrack::rtos {

VirtualPeriodicTimer::VirtualPeriodicTimer(VirtualClock& clock, Time start, Duration period)
    : clock_(clock), next_(start), period_(period) {
  assert(period > Duration::zero());
}

Wake VirtualPeriodicTimer::do_wait() {
  Wake wake{next_, 0};
  if (const Duration late = clock_.now() - next_; late > Duration::zero()) {
    const auto missed = (late + period_ - Duration(1)) / period_;  // rounded up
    wake.missed = static_cast<std::uint64_t>(missed);
    wake.due += missed * period_;
  }
  clock_.jump_to(wake.due);
  next_ = wake.due + period_;
  return wake;
}

}  // namespace dottrack::rtos
