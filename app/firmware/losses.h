#pragma once
// What devices lost between two looks, in words.

#include <optional>
#include <string>

#include "drivers/libcamera/libcamera_grabber.h"
#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::firmware {

// "camera cam5: 3 frames lost, 1 late, 2 damaged"; nothing when nothing was.
std::optional<std::string> losses(const std::string& camera, const drivers::CameraHealth& before,
                                  const drivers::CameraHealth& now);

// "CAN: 12 error frames, 1 bus-off"; nothing when there was none.
std::optional<std::string> losses(const drivers::SocketCanCounts& before,
                                  const drivers::SocketCanCounts& now);

}  // namespace dottrack::firmware
