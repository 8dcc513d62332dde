#include "rtos_shim/posix_rt/device_watchdog.h"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <limits>

#include "rtos_shim/posix_rt/system_error.h"

namespace dottrack::rtos {
namespace {

using std::chrono::seconds;

constexpr char kKick = '\0';
constexpr char kDisarm = 'V';

// A failed write shows by itself: nobody was kicked, and the board restarts.
void tell(const FileDescriptor& device, char word) {
  [[maybe_unused]] const auto written = ::write(device.get(), &word, 1);
}

int whole_seconds(Duration timeout) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  const std::int64_t rounded = std::chrono::ceil<seconds>(timeout).count();
  return static_cast<int>(std::clamp<std::int64_t>(rounded, 1, kMost));
}

// What the device took, in seconds.
Result<int> set_timeout(const std::string& name, const FileDescriptor& device, int timeout_s) {
  watchdog_info about{};
  if (ioctl(device.get(), WDIOC_GETSUPPORT, &about) != 0) {
    return fail(name + ": not a watchdog; expected a device such as /dev/watchdog0");
  }
  if ((about.options & WDIOF_SETTIMEOUT) != 0) {
    int wanted_s = timeout_s;
    if (ioctl(device.get(), WDIOC_SETTIMEOUT, &wanted_s) != 0) {
      return fail(name + ": no timeout of " + std::to_string(timeout_s) +
                  " s: " + reason_of(errno) + "; expected one that the device can do");
    }
  }
  int taken_s = 0;
  if (ioctl(device.get(), WDIOC_GETTIMEOUT, &taken_s) != 0 || taken_s <= 0) {
    return fail(name + ": does not tell its timeout; expected a watchdog that does");
  }
  return taken_s;
}

}  // namespace

Result<std::unique_ptr<DeviceWatchdog>> DeviceWatchdog::open(const std::string& name,
                                                             Duration timeout) {
  FileDescriptor device(::open(name.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  if (!device.is_open()) {
    return fail(name + ": cannot be opened: " + reason_of(errno) +
                "; expected a watchdog that no other program holds");
  }
  const Result<int> taken_s = set_timeout(name, device, whole_seconds(timeout));
  if (!taken_s) {
    tell(device, kDisarm);
    return tl::unexpected<Error>(taken_s.error());
  }
  return std::make_unique<DeviceWatchdog>(std::move(device), seconds(*taken_s));
}

void DeviceWatchdog::disarm() {
  if (!device_.is_open()) return;
  tell(device_, kDisarm);
  device_.close();
}

void DeviceWatchdog::do_kick() {
  if (device_.is_open()) tell(device_, kKick);
}

}  // namespace dottrack::rtos
