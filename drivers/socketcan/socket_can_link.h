#pragma once
// The CAN interface that a raw socket is bound to.

#include <linux/can.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drivers/socketcan/can_link.h"

namespace dottrack::drivers {

// Which frames the socket receives besides all error frames: exactly these data frames. An
// identifier above 0x7FF is an extended one; if `extended`, each one is.
std::vector<can_filter> filters_for(std::span<const std::uint32_t> ids, bool extended = false);

class SocketCanLink final : public CanLink {
 public:
  SocketCanLink(int descriptor, std::string interface, std::vector<can_filter> filters);

  // False with errno set. The interface may be down.
  bool bind();

 private:
  LinkState do_look() override;
  LinkState do_bind_again() override;

  int descriptor_;
  std::string interface_;
  std::vector<can_filter> filters_;
  int index_ = 0;
};

}  // namespace dottrack::drivers
