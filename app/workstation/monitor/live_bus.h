#pragma once
// A CAN interface of this machine, to listen to a unit's messages.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/core/protocol/addressing.h"
#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::monitor {

// All identifiers of a unit, or those with these offsets from its base. CAN FD where the interface
// is set up for it.
Result<std::unique_ptr<drivers::SocketCanBus>> listen_to(const std::string& interface,
                                                         const protocol::Addressing& addressing,
                                                         const rtos::Clock& clock,
                                                         std::vector<std::uint32_t> offsets = {});

}  // namespace dottrack::monitor
