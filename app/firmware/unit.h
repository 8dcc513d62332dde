#pragma once
// The unit at work: devices, tracker, the loop's thread and the threads that serve it.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/config/broadcast.h"
#include "app/config/rig_file.h"
#include "app/core/tracker.h"
#include "app/cycle/cycle.h"
#include "app/cycle/requests.h"
#include "app/firmware/continuity.h"
#include "app/firmware/degradation.h"
#include "app/firmware/hardware.h"
#include "app/telemetry/frame_ring.h"
#include "app/telemetry/recorder.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "rtos_shim/posix_rt/posix_thread.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::firmware {

// A configuration and the tracker made of it: exchanged together.
struct LoadedTracker {
  explicit LoadedTracker(config::RigConfig loaded)
      : config(std::move(loaded)),
        tracker(config.rig),
        broadcast(config::broadcast_settings(config)) {}

  config::RigConfig config;
  core::Tracker tracker;
  protocol::BroadcastSettings broadcast;
};

class Unit {
 public:
  // Opens every device.
  static Result<std::unique_ptr<Unit>> open(const config::RigConfig& config,
                                            Degradation& degradation);
  // Ends the loop as stop() does.
  ~Unit();
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  // Starts the threads. `watchdog` may be null; it is kicked by every tick and outlives this.
  Result<void> start(rtos::Watchdog* watchdog, const Continuity& before, Degradation& degradation);
  // Ends the loop after the tick it is in: lenses to their own control, a last message on CAN.
  void stop();
  // Once it has ended: what the next one goes on with.
  Continuity continuity() const;

  // Whether a configuration differs from the one in force in nothing but what a tracker is made of.
  bool takes(const config::RigConfig& config) const;
  // The tracker of such a configuration takes over between two ticks; returns when it has.
  void exchange(config::RigConfig config);

  const config::RigConfig& config() const { return loaded_->config; }
  Hardware& hardware() { return *hardware_; }
  telemetry::RecordRing& records() { return *records_; }
  cycle::Requests& requests() { return requests_; }
  telemetry::FrameRing* frames() { return frames_.get(); }  // null unless frames are recorded

  // From any thread.
  std::uint64_t ticks() const { return ticks_.load(std::memory_order_relaxed); }
  std::uint32_t resets() const { return resets_.load(std::memory_order_relaxed); }
  std::uint64_t heap_calls() const { return heap_calls_.load(std::memory_order_relaxed); }

 private:
  explicit Unit(const config::RigConfig& config);

  Result<void> open_devices(Degradation& degradation);
  void make_cycle(rtos::Watchdog* watchdog, const Continuity& before);
  void run_loop();
  void run_irises();

  rtos::MonotonicClock clock_;
  std::unique_ptr<LoadedTracker> loaded_;
  std::unique_ptr<Hardware> hardware_;
  std::unique_ptr<telemetry::RecordRing> records_;
  std::unique_ptr<telemetry::FrameRing> frames_;
  cycle::Requests requests_;
  exposure::LightControl light_;
  std::optional<cycle::Cycle> cycle_;

  std::atomic<bool> ending_{false};
  std::atomic<bool> irises_ending_{false};
  std::atomic<bool> not_real_time_{false};
  std::atomic<LoadedTracker*> next_{nullptr};
  std::atomic<std::uint64_t> ticks_{0};
  std::atomic<std::uint32_t> resets_{0};
  std::atomic<std::uint64_t> heap_calls_{0};
  rtos::PosixThread iris_thread_;
  rtos::PosixThread loop_thread_;
};

}  // namespace dottrack::firmware
