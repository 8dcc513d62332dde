#pragma once
// Where the time comes from. Only this interface tells it; the tracker core never asks.

#include "hal/base/time.h"

namespace dottrack::rtos {

// Contract: monotonic (never behind an earlier answer), allocation-free, callable from any thread.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  Time now() const { return do_now(); }

 private:
  virtual Time do_now() const = 0;
};

}  // namespace dottrack::rtos
