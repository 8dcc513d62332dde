#include "rtos_shim/posix_rt/service_manager.h"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::rtos {
namespace {

using std::chrono::microseconds;

constexpr std::string_view kKick = "WATCHDOG=1";

void notify(const std::string& state) {
  sd_notify(0, state.c_str());
}

// Of a path, or, when it begins with '@', of a name in the abstract namespace. 0: neither.
socklen_t write_address(std::string_view name, sockaddr_un& address) {
  const bool meaningful = name.size() > 1 && (name.front() == '/' || name.front() == '@');
  if (!meaningful || name.size() >= sizeof address.sun_path) return 0;
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path);
  if (name.front() == '@') address.sun_path[0] = '\0';
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
}

}  // namespace

// A socket of its own for the kicks: the library opens one for each message and may block.
ServiceManager::ServiceManager() {
  const char* name = std::getenv("NOTIFY_SOCKET");
  if (name != nullptr) address_bytes_ = write_address(name, address_);
  if (address_bytes_ > 0) socket_ = FileDescriptor(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
}

void ServiceManager::ready() const {
  notify("READY=1");
}

void ServiceManager::reloading() const {
  const Duration now = MonotonicClock().now().time_since_epoch();
  const auto now_us = std::chrono::floor<microseconds>(now).count();
  notify("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(now_us));
}

void ServiceManager::stopping() const {
  notify("STOPPING=1");
}

// A second line would be a second message.
void ServiceManager::status(std::string_view text) const {
  std::string line(text);
  std::ranges::replace(line, '\n', ' ');
  notify("STATUS=" + line);
}

std::optional<Duration> ServiceManager::watchdog_period() const {
  std::uint64_t period_us = 0;
  if (!is_listening() || sd_watchdog_enabled(0, &period_us) <= 0) return std::nullopt;
  return microseconds(period_us);
}

void ServiceManager::kick() const {
  if (!is_listening()) return;
  sendto(socket_.get(), kKick.data(), kKick.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
         reinterpret_cast<const sockaddr*>(&address_), address_bytes_);
}

}  // namespace dottrack::rtos
