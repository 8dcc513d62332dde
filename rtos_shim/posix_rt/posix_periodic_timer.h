#pragma once
// The loop's heartbeat on the machine's monotonic clock.

#include "rtos_shim/periodic_grid.h"
#include "rtos_shim/periodic_timer.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::rtos {

// Sleeps until absolute instants of CLOCK_MONOTONIC; a signal does not cut the sleep short.
class PosixPeriodicTimer final : public PeriodicTimer {
 public:
  // period > 0. The first instant of the grid is `start`, as MonotonicClock tells the time.
  PosixPeriodicTimer(Time start, Duration period) : grid_(start, period) {}

 private:
  Wake do_wait() override;
  Duration do_period() const override { return grid_.period(); }

  MonotonicClock clock_;
  PeriodicGrid grid_;
};

}  // namespace dottrack::rtos
