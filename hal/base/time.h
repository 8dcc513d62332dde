#pragma once
// Time as the whole system counts it: nanoseconds on one monotonic clock that is always passed in.

#include <chrono>

namespace dottrack {

using Duration = std::chrono::nanoseconds;

// The tag of the monotonic clock. It has no now(): only an rtos_shim Clock tells the time.
struct MonotonicTimeline {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MonotonicTimeline>;
  static constexpr bool is_steady = true;
};

using Time = MonotonicTimeline::time_point;

constexpr double to_seconds(Duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace dottrack
