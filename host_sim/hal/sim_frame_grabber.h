#pragma once
// The simulated cameras: triggered together, each with its latency and its faults.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hal/frame_grabber.h"
#include "host_sim/hal/hardware_model.h"
#include "host_sim/hal/sim_iris.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/scenarios/scene.h"
#include "rtos_shim/virtual_time/virtual_clock.h"

namespace dottrack::host_sim {

// One exposure and one picture a camera.
using RenderFunction = std::function<void(std::span<const Exposure>, std::vector<GreyImage>&)>;

struct SimGrabberCamera {
  double exposure_s = kReferenceExposure_s;  // at the start
  double gain = 1.0;
  double readout_s = 0.0;  // a rolling shutter's, from the first row to the last
};

struct SimGrabberSetup {
  std::vector<SimGrabberCamera> cameras = {};  // at most kMaxCameras
  GrabberModel model = {};
  std::vector<CameraFault> faults = {};
  std::uint64_t seed = 1;
};

struct GrabberCounts {
  std::uint64_t triggered = 0;  // one a camera and trigger; all others add up to this
  std::uint64_t delivered = 0;
  std::uint64_t dropped = 0;  // lost on the way
  std::uint64_t dead = 0;     // by a camera that was dead
  std::uint64_t late = 0;     // there after the deadline, and thrown away
  std::uint64_t unasked = 0;  // of cameras that nobody expected
};

// Once a tick: prepare, then trigger, await, release. All but prepare leave the heap alone. Waiting
// is a jump of the clock: to the arrival of the last expected frame, or to the deadline when one of
// them does not come by then. The same setup gives the same frames on every run.
class SimFrameGrabber final : public hal::FrameGrabber {
 public:
  // `iris` and `clock` outlive this.
  SimFrameGrabber(SimGrabberSetup setup, RenderFunction render, const SimIris& iris,
                  rtos::VirtualClock& clock);
  // The cameras of a scene, which outlives this; renders its hall: seconds. threads 0: as many as
  // the machine has.
  SimFrameGrabber(const Scene& scene, rtos::VirtualClock& clock, const SimIris& iris,
                  unsigned threads = 0);

  // Renders what the next trigger, which comes at this instant, will take. The instant is the
  // middle of every exposure (of its middle row with a rolling shutter). It may allocate.
  void prepare(Time trigger);

  // Until the next prepare(): what the last await gave, also after release().
  CameraSet delivered() const { return set_delivered_; }
  ImageView picture(std::size_t camera) const { return view(shown_[camera]); }
  Time mid_exposure(std::size_t camera) const { return set_.frames[camera].mid_exposure; }
  Time arrival(std::size_t camera) const { return arrivals_[camera]; }

  // In force for the trigger that was last prepared.
  const hal::ExposureSettings& exposure(std::size_t camera) const { return settings_[camera].now; }
  const GrabberCounts& counts() const { return counts_; }

 private:
  enum class Fate : std::uint8_t { arrives, dead, dropped };
  struct Settings {
    hal::ExposureSettings now;
    struct Wanted {
      hal::ExposureSettings settings;
      std::uint64_t tick = 0;
      bool pending = false;
    };
    std::array<Wanted, 2> wanted{};  // by the parity of the tick they are for
  };

  void do_trigger(Time now) override;
  const hal::FrameSet& do_await(CameraSet expected, Time deadline) override;
  void do_release() override { set_.delivered = CameraSet{}; }
  bool do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) override;

  void take_settings(std::size_t camera);
  Exposure exposure_of(std::size_t camera) const;
  bool has_fault(std::size_t camera, CameraFaultKind kind) const;
  double chance(std::size_t camera, std::uint64_t purpose) const;
  void show(std::size_t camera);
  void tear(std::size_t camera);
  Fate fate_of(std::size_t camera) const;
  Time arrival_of(std::size_t camera) const;

  SimGrabberSetup setup_;
  RenderFunction render_;
  const SimIris& iris_;
  rtos::VirtualClock& clock_;

  std::uint64_t tick_ = 0;  // of the next prepare()
  Time trigger_{};          // that was last prepared
  bool prepared_ = false;
  std::vector<GreyImage> rendered_;
  std::vector<GreyImage> before_;  // of the tick before
  std::vector<GreyImage> shown_;   // what the cameras deliver, faults and all

  std::array<Settings, kMaxCameras> settings_{};
  std::array<Fate, kMaxCameras> fates_{};
  std::array<Time, kMaxCameras> arrivals_{};
  CameraSet on_the_way_;
  CameraSet set_delivered_;
  hal::FrameSet set_;
  GrabberCounts counts_;
};

}  // namespace dottrack::host_sim
