#include "drivers/socketcan/interface_list.h"

#include <linux/can.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <system_error>

#include "drivers/socketcan/bit_rate.h"

namespace dottrack::drivers {
namespace {

namespace fs = std::filesystem;

// sysfs writes flags as 0x1003 and all else decimal. 0 where there is no such number: an interface
// may go while it is being looked at.
long number_in(const fs::path& file) {
  std::ifstream in(file);
  long value = 0;
  in >> std::setbase(0) >> value;
  return in ? value : 0;
}

std::string driver_of(const fs::path& interface) {
  std::error_code none;
  return fs::read_symlink(interface / "device" / "driver", none).filename().string();
}

}  // namespace

Result<std::vector<CanInterface>> can_interfaces_in(
    const fs::path& class_net, const std::function<std::uint32_t(int)>& bit_rate_of) {
  std::error_code error;
  fs::directory_iterator entries(class_net, error);
  std::vector<CanInterface> found;
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const fs::path& entry = entries->path();
    if (number_in(entry / "type") != ARPHRD_CAN) continue;
    found.push_back({.name = entry.filename().string(),
                     .driver = driver_of(entry),
                     .up = (number_in(entry / "flags") & IFF_UP) != 0,
                     .bit_rate = bit_rate_of(static_cast<int>(number_in(entry / "ifindex"))),
                     .fd = number_in(entry / "mtu") == CANFD_MTU});
  }
  if (error) return fail(class_net.string() + ": cannot list it (" + error.message() + ")");
  std::ranges::sort(found, {}, &CanInterface::name);
  return found;
}

Result<std::vector<CanInterface>> list_can_interfaces() {
  return can_interfaces_in("/sys/class/net", can_bit_rate);
}

}  // namespace dottrack::drivers
