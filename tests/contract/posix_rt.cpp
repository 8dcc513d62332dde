#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "rtos_shim/posix_rt/device_watchdog.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "rtos_shim/posix_rt/posix_periodic_timer.h"
#include "rtos_shim/posix_rt/posix_thread.h"
#include "rtos_shim/posix_rt/service_manager.h"
#include "rtos_shim/virtual_time/virtual_watchdog.h"
#include "tests/contract/clock_contract.h"
#include "tests/contract/periodic_timer_contract.h"
#include "tests/contract/thread_contract.h"
#include "tests/contract/watchdog_contract.h"

namespace dottrack::test {
namespace {

class MonotonicBench final : public TimerBench {
 public:
  rtos::PeriodicTimer& timer() override { return timer_; }
  const rtos::Clock& clock() const override { return clock_; }
  Time start() const override { return start_; }
  void spend(Duration time) override { std::this_thread::sleep_for(time); }

 private:
  rtos::MonotonicClock clock_;
  Time start_ = clock_.now() + std::chrono::milliseconds(1);
  rtos::PosixPeriodicTimer timer_{start_, kPeriod};
};

// The other end of a watchdog that is told of kicks through a file: it looks for them whenever it
// is given time to.
class ListeningBench : public WatchdogBench {
 public:
  void spend(Duration time) override {
    std::array<char, 4096> words{};
    while (::read(ear().get(), words.data(), words.size()) > 0) dog_.kick();
    clock_.jump_to(clock_.now() + time);
  }
  bool bitten() const override { return dog_.bitten(); }

 private:
  virtual const rtos::FileDescriptor& ear() const = 0;  // not blocking

  rtos::VirtualClock clock_;
  rtos::VirtualWatchdog dog_{clock_, kTimeout};
};

class DeviceBench final : public ListeningBench {
 public:
  rtos::Watchdog& watchdog() override { return watchdog_; }

 private:
  struct Pipe {
    Pipe() {
      std::array<int, 2> ends{-1, -1};
      if (::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) std::abort();
      out = rtos::FileDescriptor(ends[0]);
      in = rtos::FileDescriptor(ends[1]);
    }
    rtos::FileDescriptor out, in;
  };

  const rtos::FileDescriptor& ear() const override { return pipe_.out; }

  Pipe pipe_;
  rtos::DeviceWatchdog watchdog_{std::move(pipe_.in), kTimeout};
};

class ServiceBench final : public ListeningBench {
 public:
  ServiceBench() {
    const std::string name = "@dottrack-contract-" + std::to_string(::getpid());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data() + 1, name.size() - 1);
    const auto bytes = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    if (::bind(ear_.get(), reinterpret_cast<const sockaddr*>(&address), bytes) != 0) std::abort();
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "4000000", 1);
    manager_.emplace();
    watchdog_.emplace(*manager_, manager_->watchdog_period().value());
  }
  ~ServiceBench() override {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
  }
  rtos::Watchdog& watchdog() override { return *watchdog_; }

 private:
  const rtos::FileDescriptor& ear() const override { return ear_; }

  rtos::FileDescriptor ear_{::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  std::optional<rtos::ServiceManager> manager_;
  std::optional<rtos::ServiceWatchdog> watchdog_;
};

INSTANTIATE_TEST_SUITE_P(Monotonic, ClockContract,
                         testing::Values(ClockCase{
                             "clock", [] { return std::make_unique<rtos::MonotonicClock>(); }}));

INSTANTIATE_TEST_SUITE_P(Posix, PeriodicTimerContract,
                         testing::Values(TimerCase{
                             "timer", [] { return std::make_unique<MonotonicBench>(); }}));

INSTANTIATE_TEST_SUITE_P(
    Posix, WatchdogContract,
    testing::Values(WatchdogCase{"device", [] { return std::make_unique<DeviceBench>(); }},
                    WatchdogCase{"service", [] { return std::make_unique<ServiceBench>(); }}));

INSTANTIATE_TEST_SUITE_P(Posix, ThreadContract,
                         testing::Values(ThreadCase{
                             "thread", [] { return std::make_unique<rtos::PosixThread>(); }}));

}  // namespace
}  // namespace dottrack::test
