#pragma once
// How full the unit's messages make the bus at worst, and whether that is too full.

#include <optional>
#include <string>

#include "app/config/unit_config.h"
#include "app/core/protocol/bus_load.h"
#include "hal/base/time.h"

namespace dottrack::config {

// What the load depends on. To judge by the bit rates that an interface has in fact, put them into
// can.bit_rates.
struct CanUse {
  CanConfig can;
  unsigned dots = 0;  // of the largest target
  double frame_rate_hz = 30.0;
};

protocol::BusLoad bus_load(const CanUse& use);

// One line: "CAN: 21.4 % of 500 kbit/s, fullest group 45 frames in 12.2 ms".
std::string describe(const CanUse& use);

// Rounded up to tenths, for people: a load is never understated.
double tenths(double value);

// Of a group, all the frames go out between two ticks; the vehicle's other nodes need room, too.
inline constexpr double kLargestGroup = 0.5;  // share of a tick's period

struct Overload {
  std::string what;      // "CAN: 83.2 % of 250 kbit/s, ..."
  std::string expected;  // "up to 70 % (max_load), for instance with dots_every = 0"
};

// Nothing where the messages fit: not more than max_load on average, and the fullest group within
// half the time of a tick.
std::optional<Overload> overload(const CanUse& use);

}  // namespace dottrack::config
