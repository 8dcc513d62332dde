#pragma once
// The tick: capture, track, broadcast, expose, record.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/exposure/light_control.h"
#include "app/core/protocol/broadcast_settings.h"
#include "app/core/tracker.h"
#include "app/cycle/broadcaster.h"
#include "app/cycle/requests.h"
#include "app/telemetry/frame_ring.h"
#include "app/telemetry/recorder.h"
#include "hal/can_bus.h"
#include "hal/frame_grabber.h"
#include "hal/iris.h"
#include "hal/output_line.h"
#include "rtos_shim/clock.h"
#include "rtos_shim/periodic_timer.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::cycle {

struct CycleSettings {
  std::size_t cameras = 0;    // of the rig: the first ones of the grabber
  Duration frame_deadline{};  // after a tick's instant; a later frame is left out of the tick
  Duration send_deadline{};   // after a tick's instant; a frame not sent by then is dropped
  std::size_t dots = 0;       // of the target
  protocol::BroadcastSettings broadcast = {};
  std::uint32_t resets_before = 0;  // locks that are counted on
};

// Frames have half a period to arrive, so that as much is left for the tracker; the pose has to be
// out before the next tick begins.
CycleSettings settings_for(const core::Rig& rig, Duration period,
                           const protocol::BroadcastSettings& broadcast = {});

// What the loop is made of; all of it outlives the loop. `clock` is the loop's time; `stopwatch`
// only measures how long stages take and has no influence on anything else.
struct CycleParts {
  hal::FrameGrabber& grabber;
  hal::Iris& iris;
  hal::CanBus& can;
  core::Tracker& tracker;
  const rtos::Clock& clock;
  const rtos::Clock& stopwatch;
  telemetry::RecordRing& records;
  // Only a unit has all of these.
  telemetry::FrameRing* frames = nullptr;   // takes copies of the images
  hal::OutputLine* lamp = nullptr;          // lit: tracking; blinking: looking for the target
  rtos::Watchdog* watchdog = nullptr;       // kicked by every tick
  Requests* requests = nullptr;             // takes what commands ask of others
  exposure::LightControl* light = nullptr;  // none: cameras and lenses are left as they are
};

// The same on the board and on a workstation: one call a wake-up. It allocates nothing, throws
// nothing and waits for nothing past the deadlines of its settings.
class Cycle {
 public:
  Cycle(const CycleParts& parts, const CycleSettings& settings)
      : parts_(parts),
        tracker_(&parts.tracker),
        settings_(settings),
        broadcaster_(parts.can, settings.broadcast),
        resets_before_(settings.resets_before) {}

  void tick(const rtos::Wake& wake);

  // Between two ticks: another tracker for the same cameras from now on, perhaps of another target.
  // Locks are counted on.
  void use(core::Tracker& tracker, std::size_t dots, const protocol::IdentityMessage& identity);

  // From now on every message says so.
  void degrade(protocol::Degraded reason) { broadcaster_.degrade(reason); }

  // After the last tick: the lenses back to their own control, the lamp off, and one more message
  // on CAN that says that there is no pose and why.
  void farewell(Time now);

  // What a loop after this one goes on with.
  std::uint8_t next_sequence() const { return broadcaster_.next_sequence(); }
  std::uint32_t resets() const { return resets_before_ + tracker_resets_; }

 private:
  const hal::FrameSet& capture(Time due);
  void track(const hal::FrameSet& frames);
  void keep(const hal::FrameSet& frames);
  void broadcast();
  void obey(Time deadline);
  bool carry_out(const protocol::Command& command);
  void read_light();
  void expose();
  void control_light(std::size_t camera, const hal::IrisState& iris);
  void record();

  CycleParts parts_;
  core::Tracker* tracker_;
  CycleSettings settings_;
  std::array<core::CameraFrame, kMaxCameras> frames_{};
  Broadcaster broadcaster_;
  std::uint64_t ticks_ = 0;
  std::uint32_t resets_before_;       // locks of the trackers before this one
  std::uint32_t tracker_resets_ = 0;  // and of this one
  telemetry::CycleRecord record_;
  telemetry::CycleCounters told_;  // as the last message went out
};

}  // namespace dottrack::cycle
