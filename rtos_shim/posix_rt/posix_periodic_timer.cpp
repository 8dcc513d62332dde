#include "rtos_shim/posix_rt/posix_periodic_timer.h"

#include <time.h>

#include <cerrno>

namespace dottrack::rtos {
namespace {

timespec timespec_of(Time instant) {
  const auto whole_s = std::chrono::floor<std::chrono::seconds>(instant.time_since_epoch());
  timespec converted{};
  converted.tv_sec = static_cast<time_t>(whole_s.count());
  converted.tv_nsec = static_cast<long>((instant.time_since_epoch() - whole_s).count());
  return converted;
}

}  // namespace

Wake PosixPeriodicTimer::do_wait() {
  const Wake wake = grid_.advance(clock_.now());
  const timespec due = timespec_of(wake.due);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
  return wake;
}

}  // namespace dottrack::rtos
