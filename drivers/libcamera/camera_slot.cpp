#include "drivers/libcamera/camera_slot.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dottrack::drivers {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(100);
constexpr Duration kFirstRetry = std::chrono::seconds(1);
constexpr Duration kFirstRestart = std::chrono::seconds(30);
constexpr Duration kLastRetry = std::chrono::minutes(10);
constexpr Duration kSilence = std::chrono::seconds(2);
constexpr std::uint64_t kSilentTicks = 10;
constexpr std::uint64_t kAnswering = 2;        // ticks without a frame
constexpr std::uint64_t kPatientFailures = 8;  // in a row; then they are handed back slowly
constexpr Duration kDrain = std::chrono::seconds(5);
constexpr Duration kSlowly = std::chrono::milliseconds(200);

}  // namespace

CameraSlot::CameraSlot(LibcameraSettings settings, const SlotSurroundings& around)
    : settings_(std::move(settings)),
      around_(around),
      exchange_(around.tick_bell, around.service_bell, around.ticks),
      silent_ticks_(std::max(kSilentTicks, static_cast<std::uint64_t>(kSilence / around.period))),
      retry_in_(kFirstRetry),
      restart_in_(kFirstRestart) {}

CameraSlot::~CameraSlot() {
  exchange_.end();
  stream_.reset();
}

std::shared_ptr<libcamera::Camera> CameraSlot::camera() const {
  if (!around_.manager) return nullptr;
  return around_.manager->cameras().get(settings_.id);
}

Result<void> CameraSlot::start(Time now, bool present) {
  const Duration frame_duration = around_.triggered ? Duration::zero() : around_.period;
  const auto here = camera();
  if (!here) return fail(fmt::format("camera {} ({}): gone", settings_.name, settings_.id));
  auto stream = CameraStream::make(here, settings_, frame_duration, exchange_);
  if (!stream) return tl::unexpected(stream.error());
  auto memory = (*stream)->map_memory();
  if (!memory) return tl::unexpected(memory.error());
  exchange_.begin(std::move(*memory), present);
  stream_ = std::move(*stream);
  can_be_set_ = stream_->has_exposure();
  state_ = State::running;
  last_heard_ = now;
  auto started = stream_->start(now);
  if (!started) leave();
  return started;
}

void CameraSlot::serve(Time now) {
  if (state_ == State::running) feed(now);
  reclaim();
  if (now < next_look_) return;
  next_look_ = now + kLookEvery;
  if (state_ == State::running) watch(now);
  if (state_ == State::absent) come_back(now);
}

// A camera that does not answer is told nothing: libcamera's one thread, and with it every camera,
// would wait for the answer.
void CameraSlot::feed(Time now) {
  take_new_exposure();
  stream_->hold_controls(exchange_.silence() > kAnswering);
  while (const auto buffer = exchange_.next_returned()) stream_->queue(*buffer, now);
  const bool hopeless = exchange_.failures_in_row() > kPatientFailures;
  if (hopeless && now < next_feed_of_failed_) return;
  next_feed_of_failed_ = now + kSlowly;
  for (std::size_t i = 0; i < FrameExchange::kMaxBuffers; ++i) {  // some may fail again meanwhile
    const auto buffer = exchange_.next_failed();
    if (!buffer) break;
    stream_->note_failure(*buffer, now);
    stream_->queue(*buffer, now);
  }
}

// Stopping a silent camera may take the seconds that its bus waits for an answer, and blinds all
// others meanwhile, so it is done late and ever more rarely. It must never be done to a camera that
// was just unplugged: libcamera ends the program when it does not know of that yet. Hence
// catch_up().
void CameraSlot::watch(Time now) {
  if (camera() != stream_->camera()) {
    leave();
    return;
  }
  if (exchange_.silence() <= silent_ticks_) {
    last_heard_ = now;
    if (!exchange_.present()) return;
    retry_in_ = kFirstRetry;
    restart_in_ = kFirstRestart;
    return;
  }
  exchange_.note_silence();
  if (now - last_heard_ < restart_in_) return;
  restart_in_ = std::min(2 * restart_in_, kLastRetry);
  stream_->catch_up();
  leave();
}

bool CameraSlot::withdraw(Time now) {
  if (state_ == State::running && is_drained(now)) leave();
  reclaim();
  next_look_ = Time::min();
  return state_ == State::absent;
}

// Without requests it may be stopped whether or not it was unplugged just now.
bool CameraSlot::is_drained(Time now) {
  if (!drained_by_) drained_by_ = now + kDrain;
  while (exchange_.next_returned()) {
  }
  while (exchange_.next_failed()) {
  }
  if (camera() != stream_->camera() || exchange_.with_camera() == 0) return true;
  if (now < *drained_by_) return false;
  stream_->catch_up();
  return true;
}

void CameraSlot::reclaim() {
  if (state_ == State::leaving && exchange_.reclaim()) state_ = State::absent;
}

void CameraSlot::leave() {
  exchange_.end();
  stream_.reset();
  drained_by_.reset();
  state_ = State::leaving;
}

void CameraSlot::come_back(Time now) {
  if (!plugged_in()) return;
  if (!start(now, false)) retry_later(now);
}

void CameraSlot::retry_later(Time now) {
  next_look_ = now + retry_in_;
  retry_in_ = std::min(2 * retry_in_, kLastRetry);
}

void CameraSlot::set_exposure(const hal::ExposureSettings& settings) {
  exposure_ns_ = settings.exposure.count();
  gain_ = settings.gain;
  ++exposure_number_;
}

void CameraSlot::take_new_exposure() {
  const std::uint32_t number = exposure_number_;
  if (number == exposure_taken_) return;
  exposure_taken_ = number;
  settings_.exposure = {.exposure = Duration(exposure_ns_), .gain = gain_};
  stream_->set_exposure(settings_.exposure);
}

}  // namespace dottrack::drivers
