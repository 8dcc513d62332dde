#pragma once
// A made-up CAN interface: one end of a socket pair is the driver's, the other is the bus.

#include <linux/can/error.h>
#include <sys/socket.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drivers/socketcan/can_channel.h"

namespace dottrack::test {

// The link's flags as a test says they are.
struct MadeUpLink {
  drivers::LinkState state = drivers::LinkState::running;
  int looks = 0;
  int binds = 0;
};

class CanPair {
 public:
  CanPair() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) throw std::runtime_error("no pair");
    driver_end_.emplace(ends[0]);
    bus_end_.emplace(ends[1]);
  }

  // Once: the driver's end goes with what is made of it.
  std::unique_ptr<drivers::CanChannel> channel(bool fd, const rtos::Clock& clock) {
    return std::make_unique<drivers::CanChannel>(std::move(driver_end_.value()),
                                                 std::make_unique<Link>(link), fd, clock);
  }

  // What went out since the last call.
  std::vector<hal::CanFrame> heard() const {
    std::vector<hal::CanFrame> frames;
    drivers::WireFrame wire;
    while (bus_end_->read(wire) == drivers::CanPort::Read::frame) {
      const std::optional<hal::CanFrame> frame = drivers::from_wire(wire);
      if (!frame) throw std::runtime_error("what went out is no data frame");
      frames.push_back(*frame);
    }
    return frames;
  }

  bool bring(const drivers::WireFrame& wire) const {
    return bus_end_->write(wire) == drivers::CanPort::Written::done;
  }
  bool bring(const hal::CanFrame& frame) const { return bring(drivers::to_wire(frame).value()); }
  bool bring_error(unsigned classes, std::uint8_t controller = 0) const {
    drivers::WireFrame wire;
    wire.size = CAN_MTU;
    wire.frame.can_id = CAN_ERR_FLAG | classes;
    wire.frame.len = CAN_ERR_DLC;
    wire.frame.data[1] = controller;
    return bring(wire);
  }

  void close_bus_end() { bus_end_.reset(); }

  MadeUpLink link;

 private:
  class Link final : public drivers::CanLink {
   public:
    explicit Link(MadeUpLink& made_up) : made_up_(made_up) {}

   private:
    drivers::LinkState do_look() override {
      ++made_up_.looks;
      return made_up_.state;
    }
    drivers::LinkState do_bind_again() override {
      ++made_up_.binds;
      return made_up_.state;
    }

    MadeUpLink& made_up_;
  };

  std::optional<drivers::CanPort> driver_end_;
  std::optional<drivers::CanPort> bus_end_;
};

}  // namespace dottrack::test
