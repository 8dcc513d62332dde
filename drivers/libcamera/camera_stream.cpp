#include "drivers/libcamera/camera_stream.h"

#include <libcamera/control_ids.h>
#include <libcamera/request.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>

#include "drivers/libcamera/picture_format.h"

namespace dottrack::drivers {
namespace {

namespace controls = libcamera::controls;

constexpr unsigned kBuffers = 5;  // one in the tick, two waiting for it, two with the camera
constexpr Duration kHotplugDelay = std::chrono::milliseconds(200);  // from kernel to libcamera
constexpr Duration kTellAgainAfter = std::chrono::seconds(1);

template <class T>
T within_limits(const libcamera::ControlInfoMap& offered, const libcamera::Control<T>& control,
                T value) {
  const auto found = offered.find(control.id());
  if (found == offered.end()) return value;
  const T low = found->second.min().template get<T>();
  const T high = found->second.max().template get<T>();
  return low < high ? std::clamp(value, low, high) : value;
}

}  // namespace

CameraStream::CameraStream(std::shared_ptr<libcamera::Camera> camera,
                           const LibcameraSettings& settings, Duration frame_duration,
                           FrameExchange& exchange)
    : camera_(std::move(camera)),
      settings_(settings),
      frame_duration_(frame_duration),
      exchange_(exchange),
      allocator_(camera_),
      courier_(*camera_),
      wanted_(settings.exposure),
      told_(settings.exposure),
      exposure_ns_(settings.exposure.exposure.count()) {}

Error CameraStream::error(const std::string& what) const {
  return {"camera " + settings_.name + " (" + settings_.id + "): " + what};
}

Result<std::unique_ptr<CameraStream>> CameraStream::make(std::shared_ptr<libcamera::Camera> camera,
                                                         const LibcameraSettings& settings,
                                                         Duration frame_duration,
                                                         FrameExchange& exchange) {
  std::unique_ptr<CameraStream> stream(
      new CameraStream(std::move(camera), settings, frame_duration, exchange));
  const auto ready = stream->configure().and_then([&] { return stream->make_requests(); });
  if (!ready) return tl::unexpected(ready.error());
  return stream;
}

Result<void> CameraStream::configure() {
  const int taken = camera_->acquire();
  if (taken == -EBUSY) return tl::unexpected(error("busy: another program has it"));
  if (taken < 0) {
    return tl::unexpected(error(std::string("cannot be taken: ") + std::strerror(-taken)));
  }
  acquired_ = true;
  auto format = choose_format(*camera_, settings_.width_px, settings_.height_px, kBuffers);
  if (!format) return tl::unexpected(error(format.error().message));
  const int configured = camera_->configure(format->configuration.get());
  if (configured < 0) {
    return tl::unexpected(error(std::string("cannot be configured: ") + strerror(-configured)));
  }
  picture_ = format->picture();
  stream_ = format->configuration->at(0).stream();
  return {};
}

Result<void> CameraStream::make_requests() {
  const int allocated = allocator_.allocate(stream_);
  if (allocated < 0) {
    return tl::unexpected(error(std::string("no buffers: ") + std::strerror(-allocated)));
  }
  for (const auto& buffer : allocator_.buffers(stream_)) {
    if (requests_.size() == FrameExchange::kMaxBuffers) break;
    auto request = camera_->createRequest(requests_.size());
    if (!request || request->addBuffer(stream_, buffer.get()) < 0) {
      return tl::unexpected(error("takes no requests"));
    }
    requests_.push_back(std::move(request));
  }
  return {};
}

// Only the first plane: it holds the luma, or everything.
Result<std::unique_ptr<FrameMemory>> CameraStream::map_memory() {
  std::vector<Mapping> mappings;
  mappings.reserve(requests_.size());
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const libcamera::FrameBuffer::Plane& plane = allocator_.buffers(stream_)[i]->planes().front();
    auto mapping = Mapping::of(plane.fd.get(), plane.offset, plane.length);
    if (!mapping) return tl::unexpected(error(mapping.error().message));
    mappings.push_back(std::move(*mapping));
  }
  return std::make_unique<FrameMemory>(picture_, std::move(mappings));
}

Result<void> CameraStream::start(Time now) {
  camera_->requestCompleted.connect(this, &CameraStream::on_completed);
  connected_ = true;
  const int started = camera_->start();
  if (started < 0) {
    return tl::unexpected(error(std::string("does not start: ") + std::strerror(-started)));
  }
  for (std::size_t buffer = 0; buffer < requests_.size(); ++buffer) queue(buffer, now);
  return {};
}

// The order matters: no request may reach a camera that is stopped; stop() returns when the last
// request has been completed; and a camera that is gone completes none any more.
CameraStream::~CameraStream() {
  courier_.round_trip();
  if (connected_) {
    camera_->stop();
    camera_->requestCompleted.disconnect(this);
  }
  requests_.clear();
  if (stream_ != nullptr && allocator_.allocated()) allocator_.free(stream_);
  if (acquired_) camera_->release();
}

// That thread alternates between messages and the kernel's events: between two round trips it has
// dealt with all events that were there at the first.
void CameraStream::catch_up() {
  std::this_thread::sleep_for(kHotplugDelay);
  courier_.round_trip();
  courier_.round_trip();
}

bool CameraStream::has(unsigned control) const {
  return camera_->controls().find(control) != camera_->controls().end();
}

bool CameraStream::has_exposure() const {
  return has(controls::ExposureTime.id()) || has(controls::AnalogueGain.id());
}

void CameraStream::queue(std::size_t buffer, Time now) {
  libcamera::Request& request = *requests_[buffer];
  if (request.status() != libcamera::Request::RequestPending) {
    request.reuse(libcamera::Request::ReuseBuffers);
  }
  add_controls(request.controls(), buffer, now);
  exchange_.note_queued();
  courier_.hand_over(request);
}

void CameraStream::note_failure(std::size_t buffer, Time now) {
  if (telling_ != buffer) return;
  telling_.reset();
  manual_ = false;
  if (!wanted_) wanted_ = told_;
  tell_from_ = now + kTellAgainAfter;
}

// One thing at a time: a camera may refuse an exposure while it still sets its own.
void CameraStream::add_controls(libcamera::ControlList& controls, std::size_t buffer, Time now) {
  if (hold_ || now < tell_from_) return;
  if (!manual_) {
    manual_ = true;
    telling_ = buffer;
    if (has(controls::AeEnable.id())) controls.set(controls::AeEnable, false);
    if (frame_duration_ > Duration::zero() && has(controls::FrameDurationLimits.id())) {
      const auto us = std::chrono::duration_cast<std::chrono::microseconds>(frame_duration_);
      const std::array<std::int64_t, 2> limits{us.count(), us.count()};
      controls.set(controls::FrameDurationLimits, libcamera::Span<const std::int64_t, 2>(limits));
    }
  } else if (wanted_) {
    telling_ = buffer;
    add_exposure(controls);
  }
}

void CameraStream::add_exposure(libcamera::ControlList& controls) {
  told_ = *wanted_;
  wanted_.reset();
  if (has(controls::ExposureTime.id())) {
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(told_.exposure);
    const auto exposure_us = within_limits(camera_->controls(), controls::ExposureTime,
                                           static_cast<std::int32_t>(us.count()));
    controls.set(controls::ExposureTime, exposure_us);
    exposure_ns_ = Duration(std::chrono::microseconds(exposure_us)).count();
  }
  if (has(controls::AnalogueGain.id())) {
    const auto gain =
        within_limits(camera_->controls(), controls::AnalogueGain, static_cast<float>(told_.gain));
    controls.set(controls::AnalogueGain, gain);
  }
}

// On libcamera's thread.
void CameraStream::on_completed(libcamera::Request* request) {
  const libcamera::FrameMetadata& frame = request->findBuffer(stream_)->metadata();
  Completion completion;
  completion.buffer = request->cookie();
  if (request->status() == libcamera::Request::RequestComplete) {
    const bool whole = frame.status == libcamera::FrameMetadata::FrameSuccess;
    completion.outcome = whole ? Completion::Outcome::frame : Completion::Outcome::damaged;
    completion.bytes_used = frame.planes().empty() ? 0 : frame.planes()[0].bytesused;
    completion.sequence = frame.sequence;
    completion.mid_exposure = mid_exposure(*request, frame);
  }
  exchange_.completed(completion);
}

Time CameraStream::mid_exposure(libcamera::Request& request,
                                const libcamera::FrameMetadata& frame) const {
  const auto sensor = request.metadata().get(controls::SensorTimestamp);
  const auto used_us = request.metadata().get(controls::ExposureTime);
  const Duration stamp(sensor ? *sensor : static_cast<std::int64_t>(frame.timestamp));
  const Duration exposure =
      used_us ? Duration(std::chrono::microseconds(*used_us)) : Duration(exposure_ns_);
  return Time(stamp) - exposure / 2 + settings_.stamp_offset;
}

}  // namespace dottrack::drivers
