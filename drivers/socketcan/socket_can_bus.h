#pragma once
// A CAN controller of the Linux kernel (SocketCAN), classic or FD.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/can_bus.h"
#include "rtos_shim/clock.h"

namespace dottrack::drivers {

struct SocketCanSettings {
  std::string interface = "can0";
  bool fd = false;                             // frames of up to 64 bytes too
  std::vector<std::uint32_t> listen_ids = {};  // what receive() is for; none: nothing is received
  bool listen_extended = false;  // all of them have 29 bits; else those above 0x7FF have
};

// What happened on the interface since it was opened. Plain numbers, a snapshot.
struct SocketCanCounts {
  std::uint64_t sent = 0;
  std::uint64_t refused_full = 0;  // no room before the deadline
  std::uint64_t failed = 0;        // interface down, bus off or gone
  std::uint64_t error_frames = 0;  // told by the controller
  std::uint64_t bus_offs = 0;
  std::uint64_t recoveries = 0;   // times it could send again after bus-off, down or gone
  std::uint64_t overwritten = 0;  // received, and nobody came for them in time
};

class CanChannel;

// One thread sends, receives and asks for the state. Bus-off, down and gone are survived without
// reopening; after bus-off the kernel restarts the controller if the interface has a restart-ms.
// Frames that wait in the kernel are few, so that none goes out long after its deadline.
class SocketCanBus final : public hal::CanBus {
 public:
  // An error names the interface and what is wrong: no such interface, not CAN, no permission, no
  // FD, no CAN in this kernel. An interface that is merely down is none: it counts as absent until
  // it comes up.
  static Result<std::unique_ptr<SocketCanBus>> open(const SocketCanSettings& settings,
                                                    const rtos::Clock& clock);
  explicit SocketCanBus(std::unique_ptr<CanChannel> channel);  // for tests: over any descriptor
  ~SocketCanBus() override;

  // From any thread.
  SocketCanCounts counts() const;

 private:
  hal::SendResult do_send(const hal::CanFrame& frame, Time deadline) override;
  bool do_receive(hal::CanFrame& frame) override;
  hal::CanState do_state() const override;

  std::unique_ptr<CanChannel> channel_;
};

struct CanInterface {
  std::string name;    // can0
  std::string driver;  // kvaser_pci; empty for a virtual one
  bool up = false;
  std::uint32_t bit_rate = 0;  // 0: not set or virtual
  bool fd = false;             // set up for FD
};

// Every CAN interface of the machine, by name. Start-up only.
Result<std::vector<CanInterface>> list_can_interfaces();

}  // namespace dottrack::drivers
