#pragma once
// The loop's heartbeat in virtual time: waiting is a jump to the next due instant.

#include "rtos_shim/periodic_grid.h"
#include "rtos_shim/periodic_timer.h"
#include "rtos_shim/virtual_time/virtual_clock.h"

namespace dottrack::rtos {

class VirtualPeriodicTimer final : public PeriodicTimer {
 public:
  // period > 0. The first instant of the grid is `start`.
  VirtualPeriodicTimer(VirtualClock& clock, Time start, Duration period)
      : clock_(clock), grid_(start, period) {}

 private:
  Wake do_wait() override;
  Duration do_period() const override { return grid_.period(); }

  VirtualClock& clock_;
  PeriodicGrid grid_;
};

}  // namespace dottrack::rtos
