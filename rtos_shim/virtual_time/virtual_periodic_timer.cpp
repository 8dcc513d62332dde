#include "rtos_shim/virtual_time/virtual_periodic_timer.h"

namespace dottrack::rtos {

Wake VirtualPeriodicTimer::do_wait() {
  const Wake wake = grid_.advance(clock_.now());
  clock_.jump_to(wake.due);
  return wake;
}

}  // namespace dottrack::rtos
