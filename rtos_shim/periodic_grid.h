#pragma once
// The arithmetic of a heartbeat: which instant of the grid comes next, and how many went by. Every
// PeriodicTimer counts with it, so that all of them count alike.

#include <cassert>

#include "rtos_shim/periodic_timer.h"

namespace dottrack::rtos {

class PeriodicGrid {
 public:
  // period > 0. The first instant of the grid is `start`.
  PeriodicGrid(Time start, Duration period) : next_(start), period_(period) {
    assert(period > Duration::zero());
  }

  // The first instant not yet handed out that has not gone by at `now`.
  Wake advance(Time now) {
    Wake wake{next_, 0};
    if (const Duration late = now - next_; late > Duration::zero()) {
      const auto missed = (late + period_ - Duration(1)) / period_;  // rounded up
      wake.missed = static_cast<std::uint64_t>(missed);
      wake.due += missed * period_;
    }
    next_ = wake.due + period_;
    return wake;
  }

  Duration period() const { return period_; }

 private:
  Time next_;
  Duration period_;
};

}  // namespace dottrack::rtos
