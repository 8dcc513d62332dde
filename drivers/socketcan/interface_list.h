#pragma once
// The machine's CAN interfaces as sysfs shows them.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::drivers {

// An error names the folder. bit_rate_of gets the number that the kernel gave the interface.
Result<std::vector<CanInterface>> can_interfaces_in(
    const std::filesystem::path& class_net, const std::function<std::uint32_t(int)>& bit_rate_of);

}  // namespace dottrack::drivers
