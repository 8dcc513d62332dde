#include "rtos_shim/posix_rt/posix_periodic_timer.h"

#include <gtest/gtest.h>
#include <sys/time.h>

#include <csignal>

#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::rtos {
namespace {

using std::chrono::milliseconds;

volatile std::sig_atomic_t alarms = 0;
void count_alarm(int) {
  alarms = alarms + 1;
}

// Signals, every millisecond, that cut system calls short.
class Alarms {
 public:
  Alarms() {
    struct sigaction action {};
    action.sa_handler = count_alarm;
    sigaction(SIGALRM, &action, &before_);
    const itimerval every_ms{{0, 1000}, {0, 1000}};
    setitimer(ITIMER_REAL, &every_ms, nullptr);
  }
  Alarms(const Alarms&) = delete;
  Alarms& operator=(const Alarms&) = delete;
  ~Alarms() {
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    sigaction(SIGALRM, &before_, nullptr);
  }

 private:
  struct sigaction before_ {};
};

TEST(PosixPeriodicTimer, ASignalDoesNotWakeIt) {
  const MonotonicClock clock;
  PosixPeriodicTimer timer(clock.now(), milliseconds(20));
  const Alarms ringing;
  for (int n = 0; n < 5; ++n) {
    const Wake wake = timer.wait();
    ASSERT_GE(clock.now(), wake.due);
  }
  EXPECT_GT(alarms, 0);
}

TEST(PosixPeriodicTimer, InstantsBeforeItsFirstWaitAreMissedOnes) {
  const MonotonicClock clock;
  const Time start = clock.now() - milliseconds(95);
  PosixPeriodicTimer timer(start, milliseconds(10));
  const Wake wake = timer.wait();
  EXPECT_GE(wake.missed, 10U);
  EXPECT_EQ(wake.due, start + static_cast<Duration::rep>(wake.missed) * milliseconds(10));
}

TEST(PosixPeriodicTimer, ItsFirstInstantIsItsStart) {
  const MonotonicClock clock;
  const Time start = clock.now() + milliseconds(30);
  PosixPeriodicTimer timer(start, milliseconds(20));
  const Wake wake = timer.wait();
  EXPECT_EQ(wake.due, start + static_cast<Duration::rep>(wake.missed) * milliseconds(20));
  EXPECT_GE(clock.now(), start);
}

}  // namespace
}  // namespace dottrack::rtos
