#pragma once
// This machine's monotonic clock, as the harness counts it.

#include <chrono>

#include "hal/base/time.h"

namespace dottrack::board {

inline Time host_now() {
  return Time(
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

inline double seconds_between(Time from, Time to) {
  return to_seconds(to - from);
}

}  // namespace dottrack::board
