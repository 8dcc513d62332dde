#pragma once
// Cameras whose images were recorded: DIR/<camera>/<tick, six digits>.pgm, and perhaps
// DIR/times.csv.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/recorded/frame_times.h"
#include "hal/base/result.h"
#include "hal/frame_grabber.h"

namespace dottrack::drivers {

struct RecordedCamera {
  std::string name;  // of its folder
  int width_px = 0;
  int height_px = 0;
};

// How await() waits, a clock's jump say. Called with the instant until which it takes: the arrival
// of the last expected frame, or the deadline when an expected camera does not deliver by then.
using WaitUntil = std::function<void(Time)>;

// Without times.csv the exposure of a tick is centred on its trigger, and its frames are there at
// once. With it each frame has the times of its recording, and a frame that came after the deadline
// does not count. A camera without an image for the tick, or with one that cannot be read or of
// which times.csv does not tell, does not deliver.
class RecordedFrameGrabber final : public hal::FrameGrabber {
 public:
  // At most kMaxCameras cameras. An error when DIR holds no image of any camera that can be read,
  // or a times.csv that is wrong. `wait_until` is used with times.csv only; it must not allocate.
  static Result<std::unique_ptr<RecordedFrameGrabber>> open(const std::filesystem::path& folder,
                                                            std::vector<RecordedCamera> cameras,
                                                            WaitUntil wait_until = {});

  bool has_times() const { return times_.has_value(); }

  // One more than the highest number of an image of any camera.
  std::uint64_t recorded_ticks() const { return recorded_ticks_; }

  // Cameras of which there is no image at all.
  std::vector<std::string> silent_cameras() const;

  // Reads the images of a tick into the buffers, for the trigger that follows; a tick beyond the
  // last shows the last one again, as long after its trigger as it came after its exposure. Not for
  // the loop: it reads files and may allocate. Returns one line for every image that is there and
  // cannot be read, the first time it is met.
  std::vector<std::string> load(std::uint64_t tick);

  // Images that were there and could not be read, so far.
  std::uint64_t bad_frames() const { return bad_frames_; }

  // The image that load() read for a camera; empty when there was none.
  ImageView loaded_image(std::size_t camera) const;

 private:
  struct Source {
    RecordedCamera camera;
    std::filesystem::path folder;
    std::vector<std::uint8_t> pixels;
    bool has_images = false;
    bool loaded = false;
    FrameTimes times;  // of the loaded image
  };

  explicit RecordedFrameGrabber(const std::filesystem::path& folder,
                                std::vector<RecordedCamera> cameras, WaitUntil wait_until);

  std::string load_source(Source& source, std::uint64_t tick);
  Time await_times(CameraSet expected, Time deadline);

  void do_trigger(Time now) override;
  const hal::FrameSet& do_await(CameraSet expected, Time deadline) override;
  void do_release() override { set_.delivered = CameraSet{}; }
  bool do_set_exposure(std::size_t, const hal::ExposureSettings&) override { return false; }

  std::vector<Source> sources_;
  std::uint64_t recorded_ticks_ = 0;
  std::uint64_t loaded_tick_ = ~std::uint64_t{0};
  bool shown_again_ = false;  // what is loaded is asked for beyond its tick
  std::uint64_t bad_frames_ = 0;
  std::optional<FrameTimesTable> times_;
  WaitUntil wait_until_;
  hal::FrameSet set_;
  std::array<Time, kMaxCameras> arrivals_{};
  CameraSet exposed_;  // have an image for the trigger that was last given
};

}  // namespace dottrack::drivers
