#pragma once
// Whether the CAN interface that is there can carry what the rig file asks for.

#include <optional>
#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::firmware {

// The load at the bit rate that the interface has in fact, where it tells one; nothing where that
// fits. One line that names the interface.
std::optional<std::string> overload_of(const config::RigConfig& config,
                                       const drivers::CanInterface& interface);

// The same for the interface of that rig among those of this machine; nothing where it is not
// there, which is another fault.
std::optional<std::string> overload_of(const config::RigConfig& config,
                                       const std::vector<drivers::CanInterface>& interfaces);

}  // namespace dottrack::firmware
