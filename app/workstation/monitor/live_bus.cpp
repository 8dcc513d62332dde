#include "app/workstation/monitor/live_bus.h"

#include <numeric>
#include <utility>

namespace dottrack::monitor {

Result<std::unique_ptr<drivers::SocketCanBus>> listen_to(const std::string& interface,
                                                         const protocol::Addressing& addressing,
                                                         const rtos::Clock& clock,
                                                         std::vector<std::uint32_t> offsets) {
  if (offsets.empty()) {
    offsets.resize(protocol::kIdentifiers);
    std::iota(offsets.begin(), offsets.end(), 0U);
  }
  drivers::SocketCanSettings settings;
  settings.interface = interface;
  settings.fd = true;
  settings.listen_extended = addressing.extended;
  for (const std::uint32_t offset : offsets) {
    settings.listen_ids.push_back(addressing.base_id + offset);
  }
  auto bus = drivers::SocketCanBus::open(settings, clock);
  if (bus) return bus;
  settings.fd = false;
  return drivers::SocketCanBus::open(settings, clock);
}

}  // namespace dottrack::monitor
