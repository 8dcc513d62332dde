#include "drivers/socketcan/socket_can_link.h"

#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "drivers/socketcan/interface_query.h"

namespace dottrack::drivers {

std::vector<can_filter> filters_for(std::span<const std::uint32_t> ids, bool extended) {
  std::vector<can_filter> filters;
  filters.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    const bool has_29_bits = extended || id > CAN_SFF_MASK;
    filters.push_back(
        {.can_id = id | (has_29_bits ? CAN_EFF_FLAG : 0U),
         .can_mask = (has_29_bits ? CAN_EFF_MASK : CAN_SFF_MASK) | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

SocketCanLink::SocketCanLink(int descriptor, std::string interface, std::vector<can_filter> filters)
    : descriptor_(descriptor), interface_(std::move(interface)), filters_(std::move(filters)) {}

bool SocketCanLink::bind() {
  const std::optional<int> index = interface_index(descriptor_, interface_);
  if (!index) return false;
  // The kernel forgets a socket's filters when its interface goes.
  const auto filter_bytes = static_cast<socklen_t>(filters_.size() * sizeof(can_filter));
  if (::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FILTER, filters_.data(), filter_bytes) != 0) {
    return false;
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = *index;
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (::bind(descriptor_, generic, sizeof(address)) != 0) return false;
  index_ = *index;
  return true;
}

LinkState SocketCanLink::do_look() {
  if (interface_index(descriptor_, interface_) != index_) return LinkState::gone;
  const std::optional<unsigned> flags = interface_flags(descriptor_, interface_);
  if (!flags) return LinkState::gone;
  if ((*flags & IFF_UP) == 0) return LinkState::down;
  return (*flags & IFF_RUNNING) != 0 ? LinkState::running : LinkState::no_carrier;
}

LinkState SocketCanLink::do_bind_again() {
  return bind() ? look() : LinkState::gone;
}

}  // namespace dottrack::drivers
