#pragma once
// Data frames that were read while looking for error frames: they share one socket and one order.

#include <array>
#include <cstddef>

#include "hal/can_bus.h"

namespace dottrack::drivers {

class FrameInbox {
 public:
  static constexpr std::size_t kCapacity = 64;

  // False if the oldest frame had to go for it.
  bool put(const hal::CanFrame& frame) {
    const bool room = size_ < kCapacity;
    frames_[(first_ + size_) % kCapacity] = frame;
    if (room) {
      ++size_;
    } else {
      first_ = (first_ + 1) % kCapacity;
    }
    return room;
  }

  bool take(hal::CanFrame& frame) {
    if (size_ == 0) return false;
    frame = frames_[first_];
    first_ = (first_ + 1) % kCapacity;
    --size_;
    return true;
  }

 private:
  std::array<hal::CanFrame, kCapacity> frames_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace dottrack::drivers
