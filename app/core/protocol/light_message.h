#pragma once
// How one camera stands with the light, as a message that belongs to no group.

#include <cstdint>

#include "app/core/exposure/camera_light.h"
#include "app/core/protocol/addressing.h"
#include "hal/base/can_frame.h"

namespace dottrack::protocol {

// `camera`: of the rig, from 0 to 15. `sequence` counts these messages, modulo 256. While the
// light is off, nobody knows what the camera is set to: exposure, gain and opening are "not
// available", as are an exposure outside 0 to 1.048574 s, a gain outside 0 to 40.94 and an opening
// outside 0 to 1. Rounded to the nearest step. No allocation.
hal::CanFrame encode_light(std::uint8_t camera, const exposure::CameraLight& light,
                           const Addressing& addressing, std::uint8_t sequence);

}  // namespace dottrack::protocol
