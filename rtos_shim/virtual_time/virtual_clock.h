#pragma once
// Time that stands still until somebody moves it: a run on it takes as long as its computing does.

#include <algorithm>

#include "rtos_shim/clock.h"

namespace dottrack::rtos {

// Single-threaded, like every run in virtual time.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(Time start = Time{}) : now_(start) {}

  // Jumps to an instant; one that has gone by already changes nothing.
  void jump_to(Time instant) { now_ = std::max(now_, instant); }

 private:
  Time do_now() const override { return now_; }

  Time now_;
};

}  // namespace dottrack::rtos
