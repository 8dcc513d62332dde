#pragma once
// The board's hardware watchdog: a /dev/watchdog* of the kernel.

#include <memory>
#include <string>

#include "hal/base/result.h"
#include "rtos_shim/posix_rt/file_descriptor.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::rtos {

// Opening the device arms it. Destruction without disarm() leaves it armed: a program that ends
// unasked is a reason to restart the board.
class DeviceWatchdog final : public Watchdog {
 public:
  // Asks for a timeout, rounded up to whole seconds. timeout() then tells what the device took,
  // which may be another one. After an error the device is not armed.
  static Result<std::unique_ptr<DeviceWatchdog>> open(const std::string& device, Duration timeout);

  // Takes over a device that is open without blocking, armed, and set to this timeout.
  DeviceWatchdog(FileDescriptor device, Duration timeout)
      : device_(std::move(device)), timeout_(timeout) {}

  // For a clean end; later kicks do nothing. A kernel told to keep watchdogs armed (nowayout) does.
  void disarm();

 private:
  void do_kick() override;
  Duration do_timeout() const override { return timeout_; }

  FileDescriptor device_;
  Duration timeout_;
};

}  // namespace dottrack::rtos
