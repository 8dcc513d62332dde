#pragma once
// Cameras through libcamera: up to 16, each found by its id.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/frame_grabber.h"
#include "hal/output_line.h"
#include "rtos_shim/clock.h"

namespace dottrack::drivers {

struct LibcameraSettings {
  std::string name;  // of the camera in the rig, for messages
  std::string id;    // libcamera's
  int width_px = 0;
  int height_px = 0;
  hal::ExposureSettings exposure;  // at the start
  Duration stamp_offset{};         // added to what is taken for the middle of the exposure
};

// A snapshot of one camera's fate since the grabber was opened.
struct CameraHealth {
  bool present = false;      // plugged in and streaming
  std::uint64_t frames = 0;  // completed by the camera
  std::uint64_t gaps = 0;    // sequence numbers that never came
  std::uint64_t late = 0;    // frames that no tick took
  std::uint64_t errors = 0;  // frames that came damaged, or of a wrong size
  std::uint64_t departures = 0;
  std::uint64_t returns = 0;
};

// How the cameras know when to expose.
enum class Exposing : std::uint8_t {
  on_trigger,  // when the line is raised; without a line they run freely
  freely,      // at the ticks' rate, in a phase of their own, line or no line
};

// trigger() raises the trigger line, release() lowers it; without a line the cameras run freely and
// a tick takes the newest frames that were exposed together. Mid-exposure times are on the
// monotonic clock: libcamera's stamp is taken for the end of the exposure (a USB camera's is the
// arrival of a frame's first data), so they are that less half the exposure, plus stamp_offset.
//
// A camera that is unplugged, or silent for 2 s and 10 ticks, is missing from the ticks and not
// waited for until it is back; it is looked for ten times a second. One that stays silent is
// started anew after 30 s, then ever more rarely: when it does not answer at all, that costs the
// others their frames for the seconds that its bus waits. With libcamera before 0.4, every fifth to
// eighth return costs all cameras a departure of about a second.
//
// Threads: libcamera's own, which also decodes YUYV and MJPEG, and one that hands buffers back to
// the cameras. Both are started by open() and inherit the scheduling of the thread that calls it.
// In one process a camera has one grabber at a time: close the old one before the next is opened.
class LibcameraGrabber final : public hal::FrameGrabber {
 public:
  // `period`: of the ticks. `trigger` may be null. An error names the camera: no such id, no format
  // that holds grey, size not offered, device busy. With `allow_missing` a camera that is not there
  // yet is no error; it joins when it is plugged in.
  static Result<std::unique_ptr<LibcameraGrabber>> open(std::vector<LibcameraSettings> cameras,
                                                        Duration period, hal::OutputLine* trigger,
                                                        bool allow_missing,
                                                        const rtos::Clock& clock,
                                                        Exposing exposing = Exposing::on_trigger);
  ~LibcameraGrabber() override;

  // From any thread.
  CameraHealth health(std::size_t camera) const;

 private:
  class Rig;
  explicit LibcameraGrabber(std::unique_ptr<Rig> rig);

  void do_trigger(Time now) override;
  const hal::FrameSet& do_await(CameraSet expected, Time deadline) override;
  void do_release() override;
  bool do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) override;

  std::unique_ptr<Rig> rig_;
};

struct CameraListing {
  std::string id;
  std::string model;
  std::vector<std::string> sizes;  // "640x480 R8", grey or convertible ones
};

// Every camera of the machine, by id. Start-up only.
Result<std::vector<CameraListing>> list_cameras();

}  // namespace dottrack::drivers
