#include "drivers/libcamera/doorbell.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

namespace dottrack::drivers {

Doorbell::~Doorbell() {
  if (fd_ >= 0) ::close(fd_);
}

Result<void> Doorbell::open() {
  fd_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (fd_ < 0) return fail(std::string("cameras: no eventfd: ") + std::strerror(errno));
  return {};
}

void Doorbell::ring() {
  ::eventfd_write(fd_, 1);  // fails only when it has rung 2^64 - 2 times, which is ringing too
}

void Doorbell::wait(Duration at_most) {
  if (at_most > Duration::zero()) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
    const timespec timeout{.tv_sec = seconds.count(), .tv_nsec = (at_most - seconds).count()};
    pollfd bell{.fd = fd_, .events = POLLIN, .revents = 0};
    ::ppoll(&bell, 1, &timeout, nullptr);
  }
  eventfd_t rings = 0;
  ::eventfd_read(fd_, &rings);
}

}  // namespace dottrack::drivers
