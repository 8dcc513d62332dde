#pragma once
// From the bits of a message to its frame: identifier, sequence, checksum.

#include "app/core/protocol/addressing.h"
#include "app/core/protocol/can_payload.h"
#include "app/core/protocol/layout_types.h"
#include "hal/base/can_frame.h"

namespace dottrack::protocol {

class FrameWriter {
 public:
  FrameWriter(const Addressing& addressing, std::uint8_t sequence)
      : addressing_(addressing), sequence_(sequence) {}

  // `frame` is a fresh one; `word`: all signals but CRC and Sequence.
  void write(const layout::Message& message, std::uint64_t word, hal::CanFrame& frame) const;
  // A CAN FD frame of 64 bytes.
  void write(const layout::Message& message, LongPayload& payload, hal::CanFrame& frame) const;

 private:
  void head(const layout::Message& message, hal::CanFrame& frame) const;

  Addressing addressing_;
  std::uint8_t sequence_;
};

}  // namespace dottrack::protocol
