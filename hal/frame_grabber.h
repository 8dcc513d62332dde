#pragma once
// What the application asks of its cameras.

#include <array>
#include <cstdint>

#include "hal/base/camera_set.h"
#include "hal/base/image_view.h"
#include "hal/base/time.h"

namespace dottrack::hal {

struct Frame {
  ImageView image;  // valid until release()
  Time mid_exposure{};
  std::uint32_t sequence = 0;  // counts up by one a trigger; a gap is a lost frame
};

// One tick's frames, indexed by camera; frames[i] means something only where delivered has i.
struct FrameSet {
  std::array<Frame, kMaxCameras> frames{};
  CameraSet delivered;
};

struct ExposureSettings {
  Duration exposure{};
  double gain = 1.0;  // factor on the signal, 1 = unity
};

// All cameras of the unit, triggered together. Nothing here allocates or throws after construction.
// Contract: trigger, await, release, in this order, once a tick.
class FrameGrabber {
 public:
  FrameGrabber() = default;
  FrameGrabber(const FrameGrabber&) = delete;
  FrameGrabber& operator=(const FrameGrabber&) = delete;
  virtual ~FrameGrabber() = default;

  // Starts one exposure on every camera.
  void trigger(Time now) { do_trigger(now); }

  // Returns when every expected camera has delivered or the deadline is past, whichever is first.
  // A camera that did not deliver is missing from FrameSet::delivered; it is never waited for.
  const FrameSet& await(CameraSet expected, Time deadline) { return do_await(expected, deadline); }

  // Gives the buffers of the last await back; its images are no longer valid.
  void release() { do_release(); }

  // Takes effect some frames later; false when the camera cannot be set.
  bool set_exposure(std::size_t camera, const ExposureSettings& settings) {
    return do_set_exposure(camera, settings);
  }

 private:
  virtual void do_trigger(Time now) = 0;
  virtual const FrameSet& do_await(CameraSet expected, Time deadline) = 0;
  virtual void do_release() = 0;
  virtual bool do_set_exposure(std::size_t camera, const ExposureSettings& settings) = 0;
};

}  // namespace dottrack::hal
