#include "drivers/socketcan/socket_can_bus.h"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/socketcan/can_channel.h"
#include "drivers/socketcan/interface_query.h"
#include "drivers/socketcan/socket_can_link.h"

namespace dottrack::drivers {
namespace {

// A pose that leaves the queue a tick late is of no use, so room is for two groups of five frames,
// and what comes after is refused here, where it is counted. The kernel charges some 770 bytes a
// frame, classic or FD, and grants twice what is asked for.
constexpr int kSendBufferBytes = 10 * 770 / 2;
constexpr std::size_t kMostFilters = 512;  // the kernel's bound

tl::unexpected<Error> refuse(const std::string& interface, const std::string& what) {
  return fail(interface + ": " + what);
}

std::string reason() {
  return std::string(" (") + std::strerror(errno) + ")";
}

Result<CanPort> open_socket(const std::string& interface) {
  const int descriptor = ::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor >= 0) return CanPort(descriptor);
  if (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT) {
    return refuse(interface,
                  "no CAN in this kernel; expected its modules can and can_raw, and a "
                  "sandbox that permits AF_CAN");
  }
  return refuse(interface, "cannot open a CAN socket" + reason());
}

Result<void> check_interface(int descriptor, const SocketCanSettings& settings) {
  const std::string& name = settings.interface;
  const std::optional<unsigned> hardware = interface_hardware(descriptor, name);
  if (!hardware) return refuse(name, "no such network interface");
  if (*hardware != ARPHRD_CAN) return refuse(name, "is no CAN interface");
  // Down, it may still be set up for FD before it comes up.
  const bool up = (interface_flags(descriptor, name).value_or(0) & IFF_UP) != 0;
  const int mtu_bytes = interface_mtu_bytes(descriptor, name).value_or(0);
  if (settings.fd && up && mtu_bytes != CANFD_MTU) {
    return refuse(name, "is set up for classic CAN; expected FD (MTU 72) because fd is asked for");
  }
  return {};
}

template <class T>
bool set(int descriptor, int level, int option, const T& value) {
  return ::setsockopt(descriptor, level, option, &value, sizeof(value)) == 0;
}

Result<void> set_options(int descriptor, const SocketCanSettings& settings) {
  const int off = 0;
  const int fd = settings.fd ? 1 : 0;
  const can_err_mask_t all_errors = CAN_ERR_MASK;
  if (!set(descriptor, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, fd)) {
    return refuse(settings.interface, "this kernel has no CAN FD" + reason());
  }
  const bool all_set = set(descriptor, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, off) &&
                       set(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, all_errors) &&
                       set(descriptor, SOL_SOCKET, SO_SNDBUF, kSendBufferBytes);
  if (!all_set) return refuse(settings.interface, "cannot set up the CAN socket" + reason());
  return {};
}

Result<void> check_ids(const SocketCanSettings& settings) {
  if (settings.listen_ids.size() > kMostFilters) {
    return refuse(settings.interface, "listens for " + std::to_string(settings.listen_ids.size()) +
                                          " identifiers; expected at most " +
                                          std::to_string(kMostFilters));
  }
  const bool known =
      std::ranges::all_of(settings.listen_ids, [](std::uint32_t id) { return id <= CAN_EFF_MASK; });
  if (!known) return refuse(settings.interface, "an identifier to listen for has over 29 bits");
  return {};
}

}  // namespace

Result<std::unique_ptr<SocketCanBus>> SocketCanBus::open(const SocketCanSettings& settings,
                                                         const rtos::Clock& clock) {
  Result<CanPort> port =
      check_ids(settings).and_then([&] { return open_socket(settings.interface); });
  if (!port) return tl::unexpected(port.error());
  const int descriptor = port->descriptor();
  const Result<void> ready = check_interface(descriptor, settings).and_then([&] {
    return set_options(descriptor, settings);
  });
  if (!ready) return tl::unexpected(ready.error());
  auto link = std::make_unique<SocketCanLink>(
      descriptor, settings.interface, filters_for(settings.listen_ids, settings.listen_extended));
  if (!link->bind()) return refuse(settings.interface, "cannot be bound to" + reason());
  return std::make_unique<SocketCanBus>(
      std::make_unique<CanChannel>(std::move(*port), std::move(link), settings.fd, clock));
}

SocketCanBus::SocketCanBus(std::unique_ptr<CanChannel> channel) : channel_(std::move(channel)) {}

SocketCanBus::~SocketCanBus() = default;

SocketCanCounts SocketCanBus::counts() const {
  return channel_->counts();
}

hal::SendResult SocketCanBus::do_send(const hal::CanFrame& frame, Time deadline) {
  return channel_->send(frame, deadline);
}

bool SocketCanBus::do_receive(hal::CanFrame& frame) {
  return channel_->receive(frame);
}

hal::CanState SocketCanBus::do_state() const {
  return channel_->state();
}

}  // namespace dottrack::drivers
