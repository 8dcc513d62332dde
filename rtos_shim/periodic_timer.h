#pragma once
// The heartbeat of the loop: instants start + N * period, N = 0, 1, 2, ...

#include <cstdint>

#include "hal/base/time.h"

namespace dottrack::rtos {

// One wake-up.
struct Wake {
  Time due{};                // the grid instant this tick belongs to
  std::uint64_t missed = 0;  // grid instants that went by unattended since the wake-up before
};

// Contract: the grid is absolute, so no phase error grows, whatever a tick takes. wait() returns at
// the first grid instant that has not gone by yet (one that is due right now counts); those that
// went by while nobody waited are counted in `missed`, neither made up for nor hidden.
// Allocation-free; one thread waits.
class PeriodicTimer {
 public:
  PeriodicTimer() = default;
  PeriodicTimer(const PeriodicTimer&) = delete;
  PeriodicTimer& operator=(const PeriodicTimer&) = delete;
  virtual ~PeriodicTimer() = default;

  Wake wait() { return do_wait(); }
  Duration period() const { return do_period(); }

 private:
  virtual Wake do_wait() = 0;
  virtual Duration do_period() const = 0;
};

}  // namespace dottrack::rtos
