#pragma once
// A place for one camera, which comes and goes.

#include <atomic>
#include <memory>
#include <optional>

#include "drivers/libcamera/camera_stream.h"
#include "drivers/libcamera/frame_exchange.h"
#include "drivers/libcamera/shared_manager.h"

namespace dottrack::drivers {

struct SlotSurroundings {
  const std::shared_ptr<SharedManager>& manager;  // none between two
  Doorbell& tick_bell;
  Doorbell& service_bell;
  const std::atomic<std::uint64_t>& ticks;
  Duration period{};
  bool triggered = false;
};

// All but exchange(), set_exposure() and can_be_set() is the service's, or happens before it runs.
class CameraSlot {
 public:
  CameraSlot(LibcameraSettings settings, const SlotSurroundings& around);
  ~CameraSlot();
  CameraSlot(const CameraSlot&) = delete;
  CameraSlot& operator=(const CameraSlot&) = delete;

  bool plugged_in() const { return camera() != nullptr; }
  // Starts the camera, which is there and not running.
  Result<void> start(Time now, bool present);
  // Hands buffers back to the camera; notices when it is gone, and when it is back.
  void serve(Time now);
  // Instead of serve(): gives the camera up, and returns true when everything of it is back.
  bool withdraw(Time now);

  FrameExchange& exchange() { return exchange_; }
  const FrameExchange& exchange() const { return exchange_; }
  const LibcameraSettings& settings() const { return settings_; }

  // From one thread, any. Takes effect with a buffer that is handed to the camera afterwards.
  void set_exposure(const hal::ExposureSettings& settings);
  bool can_be_set() const { return can_be_set_; }

 private:
  enum class State : std::uint8_t { absent, running, leaving };

  std::shared_ptr<libcamera::Camera> camera() const;
  bool is_drained(Time now);
  void feed(Time now);
  void watch(Time now);
  void leave();
  void reclaim();
  void come_back(Time now);
  void retry_later(Time now);
  void take_new_exposure();

  LibcameraSettings settings_;
  SlotSurroundings around_;
  FrameExchange exchange_;
  std::unique_ptr<CameraStream> stream_;
  State state_ = State::absent;
  std::uint64_t silent_ticks_;  // after so many without a frame, the camera is not waited for
  Time last_heard_ = Time::min();
  std::optional<Time> drained_by_;  // the camera gets no buffers any more
  Time next_look_ = Time::min();
  Time next_feed_of_failed_ = Time::min();
  Duration retry_in_;    // when it does not start
  Duration restart_in_;  // when it is silent

  // The tick writes these in this order; the service takes them when the number has changed.
  std::atomic<Duration::rep> exposure_ns_{0};
  std::atomic<double> gain_{1.0};
  std::atomic<std::uint32_t> exposure_number_{0};
  std::uint32_t exposure_taken_ = 0;
  std::atomic<bool> can_be_set_{false};
};

}  // namespace dottrack::drivers
