#pragma once
// The network interface beneath a CAN socket, as the kernel's link flags show it.

#include <cstdint>

namespace dottrack::drivers {

enum class LinkState : std::uint8_t {
  running,
  no_carrier,  // up, but off the bus
  down,
  gone,  // no such interface, or the socket is no longer bound to it
};

// Contract: neither waits nor allocates.
class CanLink {
 public:
  CanLink() = default;
  CanLink(const CanLink&) = delete;
  CanLink& operator=(const CanLink&) = delete;
  virtual ~CanLink() = default;

  LinkState look() { return do_look(); }
  // After `gone`: binds the socket to the interface of that name if there is one again.
  LinkState bind_again() { return do_bind_again(); }

 private:
  virtual LinkState do_look() = 0;
  virtual LinkState do_bind_again() = 0;
};

}  // namespace dottrack::drivers
