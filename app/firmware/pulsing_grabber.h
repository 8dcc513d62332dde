#pragma once
// Cameras that run freely, and a trigger line that pulses all the same: for lamps that flash, or
// instruments that listen.

#include "hal/frame_grabber.h"
#include "hal/output_line.h"

namespace dottrack::firmware {

class PulsingGrabber final : public hal::FrameGrabber {
 public:
  // Both outlive this.
  PulsingGrabber(hal::FrameGrabber& cameras, hal::OutputLine& line)
      : cameras_(cameras), line_(line) {}

 private:
  void do_trigger(Time now) override {
    line_.set(true);
    cameras_.trigger(now);
  }
  const hal::FrameSet& do_await(CameraSet expected, Time deadline) override {
    return cameras_.await(expected, deadline);
  }
  void do_release() override {
    cameras_.release();
    line_.set(false);
  }
  bool do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) override {
    return cameras_.set_exposure(camera, settings);
  }

  hal::FrameGrabber& cameras_;
  hal::OutputLine& line_;
};

}  // namespace dottrack::firmware
