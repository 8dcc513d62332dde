#pragma once
// Frames as the receiver for vehicles has them, and back.

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/base/can_frame.h"

namespace dottrack::protocol {

inline dottrack_frame to_receiver(const hal::CanFrame& frame) {
  dottrack_frame converted{};
  converted.id = frame.id;
  converted.extended = frame.extended;
  converted.length =
      static_cast<std::uint8_t>(std::min<std::size_t>(frame.length, std::size(converted.data)));
  std::copy_n(frame.data.begin(), converted.length, converted.data);
  return converted;
}

// A classic one: commands are.
inline hal::CanFrame from_receiver(const dottrack_frame& frame) {
  hal::CanFrame converted;
  converted.id = frame.id;
  converted.extended = frame.extended;
  converted.length = frame.length;
  std::copy_n(frame.data, std::min<std::size_t>(frame.length, std::size(frame.data)),
              converted.data.begin());
  return converted;
}

}  // namespace dottrack::protocol
