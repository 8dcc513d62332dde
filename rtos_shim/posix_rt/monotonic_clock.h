#pragma once
// The machine's own monotonic clock.

#include "rtos_shim/clock.h"

namespace dottrack::rtos {

// CLOCK_MONOTONIC: nanoseconds since the machine started.
class MonotonicClock final : public Clock {
 private:
  Time do_now() const override {
    return Time(
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
  }
};

}  // namespace dottrack::rtos
