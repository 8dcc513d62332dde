#pragma once
// One camera's frames on their way from the camera to the tick and back. Knows no camera.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "drivers/libcamera/doorbell.h"
#include "drivers/libcamera/frame_memory.h"
#include "drivers/libcamera/frame_sync.h"
#include "drivers/libcamera/libcamera_grabber.h"
#include "rtos_shim/spsc_ring.h"

namespace dottrack::drivers {

// What the camera did with a buffer.
struct Completion {
  enum class Outcome : std::uint8_t { frame, damaged, cancelled };

  Outcome outcome = Outcome::cancelled;
  std::size_t buffer = 0;
  std::size_t bytes_used = 0;
  std::uint32_t sequence = 0;  // the camera's own
  Time mid_exposure{};
};

// Three sides, each one thread: the camera completes buffers, the tick takes frames and gives them
// back, the service hands buffers to the camera again. The tick never waits for the others.
class FrameExchange {
 public:
  static constexpr std::size_t kMaxBuffers = 16;

  // Rings the first bell when there is a frame, the second when there is a buffer to hand back.
  // `ticks` counts the ticks, for silence().
  FrameExchange(Doorbell& tick, Doorbell& service, const std::atomic<std::uint64_t>& ticks)
      : tick_bell_(tick), service_bell_(service), ticks_(ticks) {}

  // The service's side.
  // A run begins: at most kMaxBuffers buffers, none with the camera yet. The camera counts as
  // present at once, or when its first frame comes.
  void begin(std::unique_ptr<FrameMemory> memory, bool present);
  // The camera counts as away, until its next frame.
  void note_silence();
  // The run ends: what completes from now on is ignored.
  void end();
  // After end(): whether the tick has given everything back. The memory is then free.
  bool reclaim();
  // Before a buffer is handed to the camera.
  void note_queued() { ++with_camera_; }
  unsigned with_camera() const { return with_camera_; }
  // A buffer that the tick is done with, or one that came back without a frame.
  std::optional<std::size_t> next_returned();
  std::optional<std::size_t> next_failed();
  std::uint64_t failures_in_row() const { return failures_in_row_; }
  // Ticks since the last frame, or the begin.
  std::uint64_t silence() const {
    const std::uint64_t last = tick_of_last_frame_;  // first: it is never ahead of the ticks
    return ticks_ - last;
  }

  // The camera's side. May allocate.
  void completed(const Completion& completion);

  // The tick's side.
  bool pop(Arrival& frame) { return arrived_.try_pop(frame); }
  ImageView image(const Arrival& frame) const { return memory_->image(frame.buffer); }
  void give_back(const Arrival& frame);
  void count_late() { ++late_; }

  // Any thread.
  bool present() const { return present_; }
  CameraHealth health() const;

 private:
  void depart();
  void count_sequence(std::uint32_t sequence);
  void fail(std::size_t buffer);
  void deliver(const Completion& completion);

  Doorbell& tick_bell_;
  Doorbell& service_bell_;
  const std::atomic<std::uint64_t>& ticks_;

  // Of the camera and the service. The tick reads memory_ without it: it holds frames only while
  // the memory stays.
  std::mutex run_;
  bool running_ = false;
  std::unique_ptr<FrameMemory> memory_;
  std::optional<std::uint32_t> last_sequence_;  // the camera's
  std::uint32_t sequence_base_ = 0;             // numbers go on when a camera's begin anew
  std::uint32_t next_sequence_ = 0;

  rtos::SpscRing<Arrival, kMaxBuffers> arrived_;
  rtos::SpscRing<std::uint8_t, kMaxBuffers> returned_;
  rtos::SpscRing<std::uint8_t, kMaxBuffers> failed_;
  std::atomic<unsigned> with_camera_{0};
  std::atomic<std::uint64_t> handed_to_tick_{0};
  std::uint64_t handed_back_ = 0;

  std::atomic<bool> present_{false};
  bool departed_ = false;
  std::atomic<std::uint64_t> tick_of_last_frame_{0};
  std::atomic<std::uint64_t> failures_in_row_{0};
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<std::uint64_t> gaps_{0};
  std::atomic<std::uint64_t> late_{0};
  std::atomic<std::uint64_t> errors_{0};
  std::atomic<std::uint64_t> departures_{0};
  std::atomic<std::uint64_t> returns_{0};
};

}  // namespace dottrack::drivers
