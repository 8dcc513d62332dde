#pragma once
// The simulated CAN controller and its bus: a transmit queue before a line that others use too,
// that destroys frames, and that goes off at times.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/can_bus.h"
#include "host_sim/hal/hardware_model.h"
#include "rtos_shim/virtual_time/virtual_clock.h"

namespace dottrack::host_sim {

struct CanCounts {
  std::uint64_t accepted = 0;
  std::uint64_t refused_full = 0;  // no room before the deadline
  std::uint64_t refused_off = 0;   // the bus was off
  std::uint64_t sent = 0;          // went out on the line whole
  std::uint64_t lost = 0;          // accepted, but still in the queue when the bus went off
  std::uint64_t destroyed = 0;     // attempts that an error cut short and that were repeated
  std::uint64_t bus_offs = 0;      // by errors; the model's outages are not counted
  std::uint64_t groups = 0;        // complete and fresh, as a vehicle's receiver has them
};

// An accepted frame is handed to `log` at once, so a log shows when it was accepted. Waiting for
// room in the queue is a jump of the clock. Nothing but construction allocates.
class SimCanBus final : public hal::CanBus {
 public:
  // A frame on the line with the most stuffing it can have, interframe space included.
  struct LineBits {
    double arbitration = 0.0;  // of a classic frame: all
    double data = 0.0;         // at the rate of the data phase
  };

  static constexpr std::size_t kQueue = 64;
  static constexpr LineBits kRecovery{128.0 * 11.0, 0.0};

  // `log` and `clock` outlive this.
  SimCanBus(const CanModel& model, std::uint64_t seed, rtos::VirtualClock& clock, hal::CanBus& log);

  // A frame of somebody else for receive(); false when 64 wait already.
  bool inject(const hal::CanFrame& frame);

  // What has gone out by now.
  const CanCounts& counts();
  const std::optional<dottrack_pose>& last_pose();

  static LineBits bits(const hal::CanFrame& frame);

 private:
  struct Waiting {
    hal::CanFrame frame;
    Time done{};  // on the line
  };

  hal::SendResult do_send(const hal::CanFrame& frame, Time deadline) override;
  bool do_receive(hal::CanFrame& frame) override;
  hal::CanState do_state() const override;

  bool off(Time at) const;
  Duration bit_times(const LineBits& bits) const;
  void settle(Time now);
  void send_until(Time now);
  void go_off(Time from, Time until);
  Time transmit(const hal::CanFrame& frame, Time start);
  void on_the_line(const Waiting& waiting);

  CanModel model_;
  std::uint64_t seed_;
  hal::CanBus& log_;
  rtos::VirtualClock& clock_;

  std::array<Waiting, kQueue> queue_{};  // a ring
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  Time busy_until_{};
  Time settled_{};
  Time off_until_{};
  int error_count_ = 0;  // the controller's transmit error counter
  std::uint64_t attempts_ = 0;

  std::array<hal::CanFrame, 64> inbox_{};  // a ring
  std::size_t inbox_first_ = 0;
  std::size_t inbox_waiting_ = 0;

  dottrack_receiver receiver_{};
  std::optional<dottrack_pose> last_pose_;
  CanCounts counts_;
};

}  // namespace dottrack::host_sim
