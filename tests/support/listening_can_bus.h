#pragma once
// A bus that takes everything and tells what it took.

#include <cstddef>
#include <vector>

#include "hal/can_bus.h"

namespace dottrack::test {

class ListeningCanBus final : public hal::CanBus {
 public:
  ListeningCanBus() { frames_.reserve(kRoom); }

  // Since the last call, in order.
  std::vector<hal::CanFrame> take() {
    std::vector<hal::CanFrame> taken = frames_;
    frames_.clear();
    return taken;
  }

 private:
  static constexpr std::size_t kRoom = 4096;  // so many and nothing is allocated

  hal::SendResult do_send(const hal::CanFrame& frame, Time) override {
    frames_.push_back(frame);
    return hal::SendResult::accepted;
  }
  bool do_receive(hal::CanFrame&) override { return false; }
  hal::CanState do_state() const override { return hal::CanState::active; }

  std::vector<hal::CanFrame> frames_;
};

}  // namespace dottrack::test
