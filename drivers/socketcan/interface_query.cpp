#include "drivers/socketcan/interface_query.h"

#include <net/if.h>
#include <sys/ioctl.h>

#include <algorithm>

namespace dottrack::drivers {
namespace {

std::optional<ifreq> ask(int descriptor, std::string_view name, unsigned long question) {
  if (name.size() >= IFNAMSIZ) return std::nullopt;
  ifreq request{};
  std::ranges::copy(name, request.ifr_name);
  if (::ioctl(descriptor, question, &request) != 0) return std::nullopt;
  return request;
}

}  // namespace

std::optional<int> interface_index(int descriptor, std::string_view name) {
  const std::optional<ifreq> answer = ask(descriptor, name, SIOCGIFINDEX);
  return answer ? std::optional(answer->ifr_ifindex) : std::nullopt;
}

std::optional<int> interface_mtu_bytes(int descriptor, std::string_view name) {
  const std::optional<ifreq> answer = ask(descriptor, name, SIOCGIFMTU);
  return answer ? std::optional(answer->ifr_mtu) : std::nullopt;
}

std::optional<unsigned> interface_flags(int descriptor, std::string_view name) {
  const std::optional<ifreq> answer = ask(descriptor, name, SIOCGIFFLAGS);
  if (!answer) return std::nullopt;
  return static_cast<unsigned short>(answer->ifr_flags);
}

std::optional<unsigned> interface_hardware(int descriptor, std::string_view name) {
  const std::optional<ifreq> answer = ask(descriptor, name, SIOCGIFHWADDR);
  return answer ? std::optional<unsigned>(answer->ifr_hwaddr.sa_family) : std::nullopt;
}

}  // namespace dottrack::drivers
