#pragma once
// What a controller tells of itself in an error frame (linux/can/error.h).

#include <optional>

#include "drivers/socketcan/frame_conversion.h"
#include "hal/can_bus.h"

namespace dottrack::drivers {

struct ErrorReport {
  bool bus_off = false;
  bool restarted = false;              // after bus-off
  std::optional<hal::CanState> fault;  // active, warning or passive, when the controller says which
  std::optional<hal::CanState> counts;  // the same by its error counters, where it tells them
};

// Nothing if the frame is no error frame.
std::optional<ErrorReport> read_error_frame(const WireFrame& wire);

}  // namespace dottrack::drivers
