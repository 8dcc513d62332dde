#include "app/workstation/mavlink/udp_link.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

namespace dottrack::workstation {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

bool is_port(std::string_view text) {
  unsigned port = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, port);
  return error == std::errc{} && rest == end && port >= 1 && port <= 65535;
}

tl::unexpected<Error> malformed(const std::string& text, const char* what) {
  return fail(fmt::format(
      "\"{}\": {}; expected HOST:PORT, such as 192.168.1.10:14550 or [::1]:14550", text, what));
}

// -1 and errno if that address cannot be sent to.
int connected(const addrinfo& address) {
  const int descriptor =
      ::socket(address.ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol);
  if (descriptor < 0) return -1;
  const int yes = 1;
  ::setsockopt(descriptor, SOL_SOCKET, SO_BROADCAST, &yes, sizeof(yes));
  if (::connect(descriptor, address.ai_addr, address.ai_addrlen) == 0) return descriptor;
  const int why = errno;
  ::close(descriptor);
  errno = why;
  return -1;
}

Result<Addresses> look_up(const HostPort& target) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(target.host.c_str(), target.port.c_str(), &hints, &found);
  if (error != 0) return fail(fmt::format("host \"{}\": {}", target.host, ::gai_strerror(error)));
  return Addresses(found, &::freeaddrinfo);
}

}  // namespace

Result<HostPort> host_and_port(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return malformed(text, "there is no port");
  HostPort parts{.host = text.substr(0, colon), .port = text.substr(colon + 1)};
  if (!is_port(parts.port)) return malformed(text, "the port is not a number from 1 to 65535");
  std::string& host = parts.host;
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find_first_of(":[]") != std::string::npos) {
    return malformed(text, "an IPv6 address stands in brackets");
  }
  if (host.empty()) return malformed(text, "there is no host");
  return parts;
}

Result<UdpLink> UdpLink::open(const std::string& text) {
  const auto target = host_and_port(text);
  if (!target) return tl::unexpected(target.error());
  const auto addresses = look_up(*target);
  if (!addresses) return tl::unexpected(addresses.error());
  int why = 0;
  for (const addrinfo* next = addresses->get(); next != nullptr; next = next->ai_next) {
    const int descriptor = connected(*next);
    if (descriptor >= 0) return UdpLink(descriptor);
    why = errno;
  }
  return fail(fmt::format("\"{}\": cannot be sent to: {}", text, std::strerror(why)));
}

UdpLink::UdpLink(UdpLink&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

UdpLink::~UdpLink() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool UdpLink::send(std::span<const std::uint8_t> datagram) {
  const auto sent = ::send(descriptor_, datagram.data(), datagram.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(datagram.size());
}

}  // namespace dottrack::workstation
