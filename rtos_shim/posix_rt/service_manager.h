#pragma once
// What the program tells the service manager (systemd) that started it.

#include <sys/socket.h>
#include <sys/un.h>

#include <optional>
#include <string_view>

#include "hal/base/time.h"
#include "rtos_shim/posix_rt/file_descriptor.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::rtos {

// Started by nobody who listens (no NOTIFY_SOCKET in the environment), it does nothing. What does
// not get through is not tried again: the service manager then acts by its own time limits.
class ServiceManager {
 public:
  ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  bool is_listening() const { return socket_.is_open(); }

  // These may block and allocate.
  void ready() const;      // started, or done with reloading()
  void reloading() const;  // busy with a new configuration, until ready()
  void stopping() const;
  void status(std::string_view text) const;  // one line for a person

  // How long it waits between two kicks before it restarts the program; none: for ever.
  std::optional<Duration> watchdog_period() const;
  // Neither blocks nor allocates.
  void kick() const;

 private:
  FileDescriptor socket_;
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
};

// The service manager as a watchdog.
class ServiceWatchdog final : public Watchdog {
 public:
  // `timeout` is what manager.watchdog_period() said. The manager outlives the watchdog.
  ServiceWatchdog(const ServiceManager& manager, Duration timeout)
      : manager_(manager), timeout_(timeout) {}

 private:
  void do_kick() override { manager_.kick(); }
  Duration do_timeout() const override { return timeout_; }

  const ServiceManager& manager_;
  Duration timeout_;
};

}  // namespace dottrack::rtos
