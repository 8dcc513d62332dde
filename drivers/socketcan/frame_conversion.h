#pragma once
// hal::CanFrame to what the kernel reads and writes, and back. Strict: what one side cannot say is
// not made up.

#include <linux/can.h>

#include <cstddef>
#include <optional>

#include "hal/can_bus.h"

namespace dottrack::drivers {

// A can_frame or a canfd_frame, told apart by the size alone, as the kernel does.
struct WireFrame {
  canfd_frame frame{};
  std::size_t size = 0;  // bytes; CAN_MTU or CANFD_MTU
};

// Nothing if there is no such frame on a bus: identifier out of range, a length that does not
// exist, a change of bit rate in a classic frame.
std::optional<WireFrame> to_wire(const hal::CanFrame& frame);

// Nothing for error frames, remote requests and whatever is no well-formed data frame.
std::optional<hal::CanFrame> from_wire(const WireFrame& wire);

}  // namespace dottrack::drivers
