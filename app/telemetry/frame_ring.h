#pragma once
// Copies of a tick's frames on their way from the loop to a slow consumer.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/frame_grabber.h"

namespace dottrack::telemetry {

struct FrameSize {
  int width_px = 0;
  int height_px = 0;
};

// One tick's images and their times; frames[i] means something only where `delivered` has i.
struct FrameCopy {
  std::uint64_t tick = 0;
  Time copied{};  // on the loop's clock: all frames were there
  CameraSet delivered;
  std::array<hal::Frame, kMaxCameras> frames{};
};

// One producing and one consuming thread, without locks. All memory is taken at construction; a
// full ring takes nothing more and says so.
class FrameRing {
 public:
  // At most kMaxCameras sizes; at least one slot.
  FrameRing(std::span<const FrameSize> cameras, std::size_t slots);

  // The producer's side. False when every slot is taken; nothing is copied then. An image of
  // another size than its camera's is left out.
  [[nodiscard]] bool try_push(std::uint64_t tick, Time now, const hal::FrameSet& frames);

  // The consumer's side: the oldest, or null; pop() gives its slot back.
  const FrameCopy* front() const;
  void pop();

 private:
  struct Slot {
    FrameCopy copy;
    std::array<std::vector<std::uint8_t>, kMaxCameras> pixels;
  };

  std::vector<FrameSize> cameras_;
  std::vector<Slot> slots_;
  std::atomic<std::uint64_t> pushed_{0};
  std::atomic<std::uint64_t> popped_{0};
};

}  // namespace dottrack::telemetry
