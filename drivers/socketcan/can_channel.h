#pragma once
// What SocketCanBus does, over any descriptor and any link: a test hands in its own.

#include <atomic>
#include <memory>

#include "drivers/socketcan/can_link.h"
#include "drivers/socketcan/can_port.h"
#include "drivers/socketcan/controller_state.h"
#include "drivers/socketcan/frame_inbox.h"
#include "drivers/socketcan/socket_can_bus.h"

namespace dottrack::drivers {

class CanChannel {
 public:
  CanChannel(CanPort port, std::unique_ptr<CanLink> link, bool fd, const rtos::Clock& clock);

  hal::SendResult send(const hal::CanFrame& frame, Time deadline);
  bool receive(hal::CanFrame& frame);
  hal::CanState state();
  SocketCanCounts counts() const;  // from any thread

 private:
  using Count = std::atomic<std::uint64_t>;
  struct Counts {
    Count sent{0}, refused_full{0}, failed{0}, error_frames{0}, bus_offs{0}, recoveries{0},
        overwritten{0};
  };

  hal::SendResult write_until(const WireFrame& wire, Time deadline);
  void catch_up();  // with what the socket and the link have to tell
  void read_pending();
  void take_in(const WireFrame& wire);
  void lose(LinkState link);
  void look_at_link();
  void note(ControllerState::Change change);

  CanPort port_;
  std::unique_ptr<CanLink> link_;
  const rtos::Clock& clock_;
  bool fd_;
  bool bound_ = true;
  Time next_look_{};
  ControllerState controller_;
  FrameInbox inbox_;
  Counts counts_;
};

}  // namespace dottrack::drivers
