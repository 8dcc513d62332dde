#include "drivers/libcamera/libcamera_grabber.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "drivers/libcamera/camera_slot.h"
#include "drivers/libcamera/shared_manager.h"

namespace dottrack::drivers {
namespace {

constexpr Duration kServeAtLeastEvery = std::chrono::milliseconds(50);
constexpr Duration kQuiet = std::chrono::seconds(3);

CameraSet both(CameraSet a, CameraSet b) {
  return CameraSet(static_cast<std::uint16_t>(a.bits() & b.bits()));
}

Result<void> check(const std::vector<LibcameraSettings>& cameras, Duration period) {
  if (cameras.size() > kMaxCameras) {
    return fail(fmt::format("{} cameras; at most {} are expected", cameras.size(), kMaxCameras));
  }
  if (period <= Duration::zero()) return fail("the cameras' period has to be more than nothing");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const LibcameraSettings& camera = cameras[i];
    if (camera.width_px <= 0 || camera.height_px <= 0) {
      return fail(fmt::format("camera {}: a size of {}x{} pixels", camera.name, camera.width_px,
                              camera.height_px));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (cameras[k].id != camera.id) continue;
      return fail(fmt::format("cameras {} and {} have the same id \"{}\"", cameras[k].name,
                              camera.name, camera.id));
    }
  }
  return {};
}

}  // namespace

// Everything that outlives a tick. The tick's own are the functions down to give_back_late().
class LibcameraGrabber::Rig final : public LateFrames {
 public:
  Rig(std::shared_ptr<SharedManager> manager, Duration period, hal::OutputLine* trigger,
      bool triggered, const rtos::Clock& clock)
      : manager_(std::move(manager)),
        period_(period),
        triggered_(triggered),
        trigger_(trigger),
        clock_(clock),
        sync_(period, triggered, *this) {}
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  Result<void> open(std::vector<LibcameraSettings> cameras, bool allow_missing);

  void trigger(Time now);
  const hal::FrameSet& await(CameraSet expected, Time deadline);
  void release();
  bool set_exposure(std::size_t camera, const hal::ExposureSettings& settings);
  void give_back_late(std::size_t camera, const Arrival& frame) override;

  CameraHealth health(std::size_t camera) const { return slots_[camera]->exchange().health(); }

 private:
  Result<void> start_camera(CameraSlot& slot, bool allow_missing);
  Error no_such_camera(const LibcameraSettings& settings) const;
  void collect(Time now);
  CameraSet present() const;
  void deliver(CameraSet cameras);
  void give_back_held();
  void serve();
  bool manager_is_due(Time now);
  void renew_manager(Time now);

  std::shared_ptr<SharedManager> manager_;
  Duration period_;
  bool triggered_;
  hal::OutputLine* trigger_;
  const rtos::Clock& clock_;
  Doorbell tick_bell_;
  Doorbell service_bell_;
  std::atomic<std::uint64_t> ticks_{0};
  std::vector<std::unique_ptr<CameraSlot>> slots_;
  FrameSync sync_;
  hal::FrameSet set_;
  CameraSet held_;  // their frames are the tick's until release()
  std::atomic<bool> closing_{false};
  bool renewing_ = false;  // this and the two below are the service's
  unsigned plugged_in_ = 0;
  Time quiet_since_{};
  std::thread service_;
};

Result<void> LibcameraGrabber::Rig::open(std::vector<LibcameraSettings> cameras,
                                         bool allow_missing) {
  if (const auto bell = tick_bell_.open(); !bell) return bell;
  if (const auto bell = service_bell_.open(); !bell) return bell;
  const SlotSurroundings around{.manager = manager_,
                                .tick_bell = tick_bell_,
                                .service_bell = service_bell_,
                                .ticks = ticks_,
                                .period = period_,
                                .triggered = triggered_};
  for (LibcameraSettings& settings : cameras) {
    slots_.push_back(std::make_unique<CameraSlot>(std::move(settings), around));
    if (const auto started = start_camera(*slots_.back(), allow_missing); !started) return started;
  }
  service_ = std::thread([this] { serve(); });
  return {};
}

Result<void> LibcameraGrabber::Rig::start_camera(CameraSlot& slot, bool allow_missing) {
  if (slot.plugged_in()) return slot.start(clock_.now(), true);
  if (allow_missing) return {};
  return tl::unexpected(no_such_camera(slot.settings()));
}

Error LibcameraGrabber::Rig::no_such_camera(const LibcameraSettings& settings) const {
  std::vector<std::string> ids;
  for (const auto& camera : manager_->cameras().cameras()) ids.push_back('"' + camera->id() + '"');
  return {fmt::format("camera {}: there is no camera with the id \"{}\"; there {} {}",
                      settings.name, settings.id, ids.size() == 1 ? "is" : "are",
                      ids.empty() ? "none" : fmt::format("{}", fmt::join(ids, ", ")))};
}

LibcameraGrabber::Rig::~Rig() {
  closing_ = true;
  service_bell_.ring();
  if (service_.joinable()) service_.join();
  slots_.clear();  // before the manager
}

// The service's thread: what allocates, or takes the time that libcamera takes.
void LibcameraGrabber::Rig::serve() {
  while (!closing_) {
    service_bell_.wait(kServeAtLeastEvery);
    const Time now = clock_.now();
    if (renewing_ || manager_is_due(now)) {
      renew_manager(now);
    } else {
      for (const auto& slot : slots_) slot->serve(now);
    }
  }
}

// Not amid a burst of cameras that are plugged in, unless it cannot wait.
bool LibcameraGrabber::Rig::manager_is_due(Time now) {
  if (manager_->plugged_in() != plugged_in_) {
    plugged_in_ = manager_->plugged_in();
    quiet_since_ = now;
  }
  const bool due = manager_->is_worn_out() || (manager_->is_worn() && now - quiet_since_ > kQuiet);
  return due && SharedManager::has_one_user();
}

// Step by step: the cameras' buffers have to come back from the tick first.
void LibcameraGrabber::Rig::renew_manager(Time now) {
  renewing_ = true;
  bool free = true;
  for (const auto& slot : slots_) free = slot->withdraw(now) && free;
  if (!free) return;
  manager_.reset();
  auto fresh = SharedManager::use();
  if (!fresh) return;  // tried again
  manager_ = std::move(*fresh);
  plugged_in_ = 0;
  renewing_ = false;
}

void LibcameraGrabber::Rig::trigger(Time now) {
  give_back_held();
  ++ticks_;
  collect(now);
  sync_.begin(now);
  if (trigger_ != nullptr) trigger_->set(true);
}

void LibcameraGrabber::Rig::collect(Time now) {
  for (std::size_t camera = 0; camera < slots_.size(); ++camera) {
    Arrival frame;
    for (std::size_t i = 0; i < FrameExchange::kMaxBuffers; ++i) {
      if (!slots_[camera]->exchange().pop(frame)) break;
      sync_.add(camera, frame, now);
    }
  }
}

CameraSet LibcameraGrabber::Rig::present() const {
  CameraSet present;
  for (std::size_t camera = 0; camera < slots_.size(); ++camera) {
    if (slots_[camera]->exchange().present()) present.insert(camera);
  }
  return present;
}

const hal::FrameSet& LibcameraGrabber::Rig::await(CameraSet expected, Time deadline) {
  expected = both(expected, CameraSet::first(slots_.size()));
  Duration left{};
  do {
    tick_bell_.wait(left);
    const Time now = clock_.now();
    collect(now);
    left = deadline - now;
  } while (left > Duration::zero() && !sync_.complete(expected, both(expected, present())));
  deliver(sync_.take(expected, both(expected, present()), clock_.now()));
  service_bell_.ring();  // for what was given back as late
  return set_;
}

void LibcameraGrabber::Rig::deliver(CameraSet cameras) {
  set_.delivered = cameras;
  held_ = cameras;
  for (std::size_t camera = 0; camera < slots_.size(); ++camera) {
    if (!cameras.contains(camera)) continue;
    const Arrival& frame = sync_.taken(camera);
    set_.frames[camera] = {.image = slots_[camera]->exchange().image(frame),
                           .mid_exposure = frame.mid_exposure,
                           .sequence = frame.sequence};
  }
}

void LibcameraGrabber::Rig::release() {
  if (trigger_ != nullptr) trigger_->set(false);
  give_back_held();
  service_bell_.ring();
}

void LibcameraGrabber::Rig::give_back_held() {
  for (std::size_t camera = 0; camera < slots_.size(); ++camera) {
    if (held_.contains(camera)) slots_[camera]->exchange().give_back(sync_.taken(camera));
  }
  held_ = CameraSet{};
  set_.delivered = CameraSet{};
}

void LibcameraGrabber::Rig::give_back_late(std::size_t camera, const Arrival& frame) {
  slots_[camera]->exchange().count_late();
  slots_[camera]->exchange().give_back(frame);
}

bool LibcameraGrabber::Rig::set_exposure(std::size_t camera,
                                         const hal::ExposureSettings& settings) {
  if (camera >= slots_.size()) return false;
  slots_[camera]->set_exposure(settings);
  return slots_[camera]->can_be_set();
}

LibcameraGrabber::LibcameraGrabber(std::unique_ptr<Rig> rig) : rig_(std::move(rig)) {}
LibcameraGrabber::~LibcameraGrabber() = default;

Result<std::unique_ptr<LibcameraGrabber>> LibcameraGrabber::open(
    std::vector<LibcameraSettings> cameras, Duration period, hal::OutputLine* trigger,
    bool allow_missing, const rtos::Clock& clock, Exposing exposing) {
  if (const auto sound = check(cameras, period); !sound) return tl::unexpected(sound.error());
  auto manager = SharedManager::use();
  if (!manager) return tl::unexpected(manager.error());
  const bool triggered = trigger != nullptr && exposing == Exposing::on_trigger;
  auto rig = std::make_unique<Rig>(std::move(*manager), period, trigger, triggered, clock);
  if (const auto opened = rig->open(std::move(cameras), allow_missing); !opened) {
    return tl::unexpected(opened.error());
  }
  return std::unique_ptr<LibcameraGrabber>(new LibcameraGrabber(std::move(rig)));
}

CameraHealth LibcameraGrabber::health(std::size_t camera) const {
  return rig_->health(camera);
}

void LibcameraGrabber::do_trigger(Time now) {
  rig_->trigger(now);
}

const hal::FrameSet& LibcameraGrabber::do_await(CameraSet expected, Time deadline) {
  return rig_->await(expected, deadline);
}

void LibcameraGrabber::do_release() {
  rig_->release();
}

bool LibcameraGrabber::do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) {
  return rig_->set_exposure(camera, settings);
}

}  // namespace dottrack::drivers
