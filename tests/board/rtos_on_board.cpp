// The real-time backends on the board's own kernel.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/posix_rt/device_watchdog.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "rtos_shim/posix_rt/posix_memory_lock.h"
#include "rtos_shim/posix_rt/posix_periodic_timer.h"
#include "rtos_shim/posix_rt/posix_thread.h"

namespace dottrack::rtos {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kWatchdog = "/dev/watchdog0";

long locked_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmLck:")) return std::atol(line.c_str() + std::strlen("VmLck:"));
  }
  return -1;
}

TEST(RealTimeOnBoard, AThreadWithAPriorityIsScheduledByIt) {
  ThreadSettings settings;
  settings.name = "board";
  settings.fifo_priority = 80;
  settings.cpu = 0;
  int policy = -1;
  sched_param taken{};
  int cpu = -1;
  PosixThread thread;
  const auto started = thread.start(settings, [&] {
    pthread_getschedparam(pthread_self(), &policy, &taken);
    cpu = sched_getcpu();
  });
  if (!started) GTEST_SKIP() << started.error().message;
  thread.join();
  EXPECT_EQ(policy, SCHED_FIFO);
  EXPECT_EQ(taken.sched_priority, 80);
  EXPECT_EQ(cpu, 0);
}

TEST(RealTimeOnBoard, TheTimerKeepsItsGridUnderPriorityAndAllocatesNothing) {
  ThreadSettings settings;
  settings.name = "board";
  settings.fifo_priority = 80;
  const MonotonicClock clock;
  const Time start = clock.now() + milliseconds(20);
  int early = 0;
  std::uint64_t attended = 0;
  std::uint64_t heap_calls = 0;
  Time last{};
  PosixThread thread;
  const auto started = thread.start(settings, [&] {
    PosixPeriodicTimer timer(start, milliseconds(20));
    const AllocationTrap::Scope armed;
    for (int n = 0; n < 50; ++n) {
      const Wake wake = timer.wait();
      if (clock.now() < wake.due) ++early;
      attended += wake.missed + 1;
      last = wake.due;
    }
    heap_calls = armed.calls().total();
  });
  if (!started) GTEST_SKIP() << started.error().message;
  thread.join();
  EXPECT_EQ(early, 0);
  EXPECT_EQ(heap_calls, 0U);
  EXPECT_EQ(last, start + static_cast<Duration::rep>(attended - 1) * milliseconds(20));
}

TEST(MemoryLockOnBoard, WhatTheProcessHasIsLocked) {
  const auto locked = PosixMemoryLock().lock_all(256 * 1024);
  if (!locked) GTEST_SKIP() << locked.error().message;
  EXPECT_GT(locked_kib(), 1000);
  munlockall();
}

// Kicked for longer than its timeout and alive at the end of it, the board shows that kicks arrive;
// disarmed, it lives on for as long again.
TEST(WatchdogOnBoard, IsSetKickedAndDisarmed) {
  if (access(kWatchdog, F_OK) != 0) GTEST_SKIP() << "no " << kWatchdog << " on this machine";
  auto watchdog = DeviceWatchdog::open(kWatchdog, seconds(4));
  if (!watchdog) GTEST_SKIP() << watchdog.error().message;
  const Duration timeout = (*watchdog)->timeout();
  EXPECT_GE(timeout, seconds(1));
  EXPECT_LE(timeout, seconds(60));
  const Duration patience = timeout <= seconds(10) ? timeout * 3 / 2 : Duration{};
  for (Duration waited{}; waited < patience; waited += milliseconds(500)) {
    std::this_thread::sleep_for(milliseconds(500));
    (*watchdog)->kick();
  }
  (*watchdog)->disarm();
  std::this_thread::sleep_for(patience);
}

TEST(WatchdogOnBoard, HasOneHolder) {
  if (access(kWatchdog, F_OK) != 0) GTEST_SKIP() << "no " << kWatchdog << " on this machine";
  auto first = DeviceWatchdog::open(kWatchdog, seconds(30));
  if (!first) GTEST_SKIP() << first.error().message;
  const auto second = DeviceWatchdog::open(kWatchdog, seconds(30));
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("cannot be opened"), std::string::npos);
  (*first)->disarm();
}

TEST(WatchdogOnBoard, AKickLeavesTheHeapAlone) {
  if (access(kWatchdog, F_OK) != 0) GTEST_SKIP() << "no " << kWatchdog << " on this machine";
  auto watchdog = DeviceWatchdog::open(kWatchdog, seconds(30));
  if (!watchdog) GTEST_SKIP() << watchdog.error().message;
  std::uint64_t heap_calls = 0;
  {
    const AllocationTrap::Scope armed;
    (*watchdog)->kick();
    heap_calls = armed.calls().total();
  }
  EXPECT_EQ(heap_calls, 0U);
  (*watchdog)->disarm();
}

}  // namespace
}  // namespace dottrack::rtos
