#include "drivers/socketcan/can_port.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <iterator>
#include <utility>

namespace dottrack::drivers {
namespace {

bool is_full(int error) {
  return error == EAGAIN || error == ENOBUFS || error == EINTR;
}

// ENETDOWN and ENODEV come once, with whatever call is next, even if the link is back by then.
bool is_gone(int error) {
  constexpr int kGone[] = {ENODEV, ENXIO, EPIPE, ECONNRESET, ENOTCONN};
  return std::ranges::find(kGone, error) != std::end(kGone);
}

}  // namespace

CanPort::CanPort(CanPort&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

CanPort::~CanPort() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

CanPort::Written CanPort::write(const WireFrame& wire) const {
  const ssize_t written = ::send(descriptor_, &wire.frame, wire.size, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (written == static_cast<ssize_t>(wire.size)) return Written::done;
  if (written >= 0) return Written::refused;
  if (is_full(errno)) return Written::full;
  if (errno == ENETDOWN) return Written::down;
  return is_gone(errno) ? Written::gone : Written::refused;
}

CanPort::Read CanPort::read(WireFrame& wire) const {
  const ssize_t size = ::recv(descriptor_, &wire.frame, sizeof(wire.frame), MSG_DONTWAIT);
  if (size > 0) {
    wire.size = static_cast<std::size_t>(size);
    return Read::frame;
  }
  if (size == 0) return Read::gone;  // only a pair ends like this
  if (errno == ENETDOWN) return Read::down;
  return is_gone(errno) ? Read::gone : Read::nothing;
}

void pause_for(Duration duration) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  const timespec span{.tv_sec = seconds.count(), .tv_nsec = (duration - seconds).count()};
  // Woken early by a signal: the caller looks at its clock anyway.
  static_cast<void>(::clock_nanosleep(CLOCK_MONOTONIC, 0, &span, nullptr));
}

}  // namespace dottrack::drivers
