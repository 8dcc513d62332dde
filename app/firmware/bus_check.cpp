#include "app/firmware/bus_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace dottrack::firmware {

std::optional<std::string> overload_of(const config::RigConfig& config,
                                       const drivers::CanInterface& interface) {
  if (interface.bit_rate == 0) return std::nullopt;
  config::CanUse use = config::can_use(config);
  use.can.bit_rates.arbitration = interface.bit_rate;
  const auto overload = config::overload(use);
  if (!overload) return std::nullopt;
  return fmt::format("[can]: interface {} runs at {} kbit/s: {}; expected {}", interface.name,
                     interface.bit_rate / 1000, overload->what, overload->expected);
}

std::optional<std::string> overload_of(const config::RigConfig& config,
                                       const std::vector<drivers::CanInterface>& interfaces) {
  const auto it = std::find_if(interfaces.begin(), interfaces.end(), [&](const auto& interface) {
    return interface.name == config.unit.can.interface;
  });
  return it == interfaces.end() ? std::nullopt : overload_of(config, *it);
}

}  // namespace dottrack::firmware
