#pragma once
// What the application asks of a CAN controller, classic or FD.

#include <cstdint>

#include "hal/base/can_frame.h"
#include "hal/base/time.h"

namespace dottrack::hal {

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
