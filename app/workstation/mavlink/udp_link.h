#pragma once
// Datagrams to one address, without ever waiting for the network.

#include <cstdint>
#include <span>
#include <string>

#include "hal/base/result.h"

namespace dottrack::workstation {

struct HostPort {
  std::string host;
  std::string port;
};

// "HOST:PORT"; an IPv6 address stands in brackets.
Result<HostPort> host_and_port(const std::string& text);

class UdpLink {
 public:
  // Looks the name up, which may take a while.
  static Result<UdpLink> open(const std::string& host_and_port);

  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;
  UdpLink(UdpLink&& other) noexcept;
  UdpLink& operator=(UdpLink&&) = delete;
  ~UdpLink();

  // False when the network did not take it: full, down, or nobody listened to the one before.
  bool send(std::span<const std::uint8_t> datagram);

 private:
  explicit UdpLink(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace dottrack::workstation
