#pragma once
// What the application asks of a CAN controller, classic or FD.

#include <array>
#include <cstdint>
#include <span>

#include "hal/base/time.h"

namespace dottrack::hal {

struct CanFrame {
  std::uint32_t id = 0;
  bool extended = false;  // 29-bit identifier
  bool fd = false;        // CAN FD frame
  bool bit_rate_switch = false;
  std::uint8_t length = 0;  // bytes used in data: 0 to 8, FD up to 64
  std::array<std::uint8_t, 64> data{};

  std::span<const std::uint8_t> payload() const { return {data.data(), length}; }
};

enum class SendResult : std::uint8_t {
  accepted,   // the controller has it
  try_again,  // no room before the deadline; the frame was dropped
  failed,     // the bus is off or the device is gone
};

enum class CanState : std::uint8_t { active, warning, passive, bus_off, absent };

// Contract: nothing here blocks past the given deadline, allocates or throws after construction.
class CanBus {
 public:
  CanBus() = default;
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;
  virtual ~CanBus() = default;

  SendResult send(const CanFrame& frame, Time deadline) { return do_send(frame, deadline); }
  // Takes one received frame if there is one; false when there is none. Own frames do not come
  // back.
  bool receive(CanFrame& frame) { return do_receive(frame); }
  CanState state() const { return do_state(); }

 private:
  virtual SendResult do_send(const CanFrame& frame, Time deadline) = 0;
  virtual bool do_receive(CanFrame& frame) = 0;
  virtual CanState do_state() const = 0;
};

}  // namespace dottrack::hal
