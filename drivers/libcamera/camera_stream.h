#pragma once
// One run of one camera, from the day it is taken to the day it is given up.

#include <libcamera/camera.h>
#include <libcamera/framebuffer_allocator.h>

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/libcamera/frame_exchange.h"
#include "drivers/libcamera/libcamera_grabber.h"
#include "drivers/libcamera/request_courier.h"

namespace dottrack::drivers {

// The service's thread makes, feeds and destroys it; libcamera's own thread completes its buffers.
class CameraStream {
 public:
  // Takes the camera, configures it, makes its buffers and requests. `exchange` outlives the
  // stream. `frame_duration` zero: as the camera likes.
  static Result<std::unique_ptr<CameraStream>> make(std::shared_ptr<libcamera::Camera> camera,
                                                    const LibcameraSettings& settings,
                                                    Duration frame_duration,
                                                    FrameExchange& exchange);
  // Stops and releases the camera.
  ~CameraStream();
  CameraStream(const CameraStream&) = delete;
  CameraStream& operator=(const CameraStream&) = delete;

  // The buffers' memory, once, before start().
  Result<std::unique_ptr<FrameMemory>> map_memory();
  Result<void> start(Time now);

  // Hands a buffer to the camera, with what is to be set.
  void queue(std::size_t buffer, Time now);
  // The camera gave a buffer back without a frame: what it was told with it is told again later.
  void note_failure(std::size_t buffer, Time now);

  void set_exposure(const hal::ExposureSettings& settings) { wanted_ = settings; }
  // Whether to wait with whatever the camera is to be told.
  void hold_controls(bool hold) { hold_ = hold; }
  bool has_exposure() const;
  // Returns when libcamera knows what the kernel knew at the call; blocks as long as it is busy.
  void catch_up();
  const std::shared_ptr<libcamera::Camera>& camera() const { return camera_; }

 private:
  CameraStream(std::shared_ptr<libcamera::Camera> camera, const LibcameraSettings& settings,
               Duration frame_duration, FrameExchange& exchange);

  Result<void> configure();
  Result<void> make_requests();
  bool has(unsigned control) const;
  void add_controls(libcamera::ControlList& controls, std::size_t buffer, Time now);
  void add_exposure(libcamera::ControlList& controls);
  void on_completed(libcamera::Request* request);
  Time mid_exposure(libcamera::Request& request, const libcamera::FrameMetadata& frame) const;
  Error error(const std::string& what) const;

  std::shared_ptr<libcamera::Camera> camera_;
  LibcameraSettings settings_;
  Duration frame_duration_;
  FrameExchange& exchange_;
  Picture picture_;
  libcamera::Stream* stream_ = nullptr;
  libcamera::FrameBufferAllocator allocator_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;  // one a buffer, of the same number
  RequestCourier courier_;
  bool acquired_ = false;
  bool connected_ = false;

  bool hold_ = false;
  bool manual_ = false;                          // the camera was told to leave its exposure alone
  std::optional<hal::ExposureSettings> wanted_;  // not told yet
  hal::ExposureSettings told_;
  std::optional<std::size_t> telling_;  // the buffer that went with the last change
  Time tell_from_ = Time::min();
  std::atomic<Duration::rep> exposure_ns_{0};  // what it was told
};

}  // namespace dottrack::drivers
