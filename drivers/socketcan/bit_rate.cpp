#include "drivers/socketcan/bit_rate.h"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>

namespace dottrack::drivers {
namespace {

using Bytes = std::span<const std::byte>;

template <class T>
bool copy_head(Bytes from, T& to) {
  if (from.size() < sizeof(T)) return false;
  std::memcpy(&to, from.data(), sizeof(T));
  return true;
}

Bytes tail(Bytes bytes, std::size_t from) {
  return from < bytes.size() ? bytes.subspan(from) : Bytes{};
}

// The content of the first attribute of that type; empty if there is none.
Bytes attribute(Bytes attributes, unsigned type) {
  rtattr head{};
  while (copy_head(attributes, head) && head.rta_len >= sizeof(head) &&
         head.rta_len <= attributes.size()) {
    if ((head.rta_type & NLA_TYPE_MASK) == type) {
      return attributes.subspan(sizeof(head), head.rta_len - sizeof(head));
    }
    attributes = tail(attributes, RTA_ALIGN(head.rta_len));
  }
  return {};
}

bool is_can(Bytes link_info) {
  const Bytes kind = attribute(link_info, IFLA_INFO_KIND);
  constexpr char kCan[] = "can";
  return kind.size() == sizeof(kCan) && std::memcmp(kind.data(), kCan, sizeof(kCan)) == 0;
}

struct LinkQuestion {
  nlmsghdr head{};
  ifinfomsg link{};
};

// The kernel answers while it is being asked, so this does not wait.
bool ask(int descriptor, int interface_index) {
  LinkQuestion question;
  question.head.nlmsg_len = sizeof(question);
  question.head.nlmsg_type = RTM_GETLINK;
  question.head.nlmsg_flags = NLM_F_REQUEST;
  question.link.ifi_index = interface_index;
  return ::send(descriptor, &question, sizeof(question), 0) == sizeof(question);
}

}  // namespace

std::uint32_t bit_rate_in(std::span<const std::byte> answer) {
  nlmsghdr head{};
  if (!copy_head(answer, head) || head.nlmsg_type != RTM_NEWLINK ||
      head.nlmsg_len > answer.size()) {
    return 0;
  }
  const Bytes attributes = tail(answer.first(head.nlmsg_len), NLMSG_LENGTH(sizeof(ifinfomsg)));
  const Bytes info = attribute(attributes, IFLA_LINKINFO);
  if (!is_can(info)) return 0;
  can_bittiming timing{};
  const Bytes data = attribute(info, IFLA_INFO_DATA);
  return copy_head(attribute(data, IFLA_CAN_BITTIMING), timing) ? timing.bitrate : 0;
}

std::uint32_t can_bit_rate(int interface_index) {
  const int descriptor = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (descriptor < 0) return 0;
  std::array<std::byte, 16384> answer{};
  ssize_t size = -1;
  if (ask(descriptor, interface_index)) size = ::recv(descriptor, answer.data(), answer.size(), 0);
  ::close(descriptor);
  return size > 0 ? bit_rate_in(std::span(answer).first(static_cast<std::size_t>(size))) : 0;
}

}  // namespace dottrack::drivers
