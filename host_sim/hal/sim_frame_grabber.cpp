#include "host_sim/hal/sim_frame_grabber.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "host_sim/scenarios/scene_renderer.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

constexpr std::uint64_t kSettingsDelay_ticks = 2;
constexpr double kLate_s = 10.0;  // beyond any deadline
constexpr double kLongestExposure_s = 1.0;

// What a random number is for.
constexpr std::uint64_t kJitter = 1;
constexpr std::uint64_t kDrop = 2;
constexpr std::uint64_t kTear = 3;

Duration from_seconds(double seconds) {
  return Duration(std::llround(seconds * 1e9));
}

SimGrabberSetup setup_of(const Scene& scene) {
  SimGrabberSetup setup{{}, scene.grabber, scene.camera_faults, scene.seed};
  for (const SceneCamera& camera : scene.cameras) {
    const double readout_s = camera.sensor.line_time_s * (camera.camera.height_px() - 1);
    setup.cameras.push_back({camera.exposure_s, camera.gain, readout_s});
  }
  return setup;
}

RenderFunction renderer_of(const Scene& scene, unsigned threads) {
  auto renderer = std::make_shared<SceneRenderer>(scene, threads);
  return [renderer](std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
    renderer->render(exposures, images);
  };
}

}  // namespace

SimFrameGrabber::SimFrameGrabber(SimGrabberSetup setup, RenderFunction render, const SimIris& iris,
                                 rtos::VirtualClock& clock)
    : setup_(std::move(setup)),
      render_(std::move(render)),
      iris_(iris),
      clock_(clock),
      rendered_(setup_.cameras.size()),
      before_(setup_.cameras.size()),
      shown_(setup_.cameras.size()) {
  assert(setup_.cameras.size() <= kMaxCameras);
  for (std::size_t i = 0; i < setup_.cameras.size(); ++i) {
    settings_[i].now = {from_seconds(setup_.cameras[i].exposure_s), setup_.cameras[i].gain};
  }
}

SimFrameGrabber::SimFrameGrabber(const Scene& scene, rtos::VirtualClock& clock, const SimIris& iris,
                                 unsigned threads)
    : SimFrameGrabber(setup_of(scene), renderer_of(scene, threads), iris, clock) {}

void SimFrameGrabber::prepare(Time trigger) {
  trigger_ = trigger;
  prepared_ = true;
  set_delivered_ = CameraSet{};
  std::array<Exposure, kMaxCameras> exposures;
  const std::size_t cameras = setup_.cameras.size();
  for (std::size_t i = 0; i < cameras; ++i) {
    take_settings(i);
    exposures[i] = exposure_of(i);
  }
  std::swap(before_, rendered_);
  render_({exposures.data(), cameras}, rendered_);
  for (std::size_t i = 0; i < cameras; ++i) {
    show(i);
    fates_[i] = fate_of(i);
    arrivals_[i] = arrival_of(i);
  }
  ++tick_;
}

void SimFrameGrabber::take_settings(std::size_t camera) {
  Settings::Wanted& wanted = settings_[camera].wanted[tick_ % 2];
  if (!wanted.pending || wanted.tick != tick_) return;
  settings_[camera].now = wanted.settings;
  wanted.pending = false;
}

Exposure SimFrameGrabber::exposure_of(std::size_t camera) const {
  const hal::ExposureSettings& now = settings_[camera].now;
  Exposure exposure;
  exposure.middle_s = to_seconds(trigger_.time_since_epoch());
  exposure.duration_s = to_seconds(now.exposure);
  exposure.gain = now.gain;
  exposure.opening = iris_.opening(camera, trigger_);
  exposure.noise = {setup_.seed, camera, tick_};
  return exposure;
}

bool SimFrameGrabber::has_fault(std::size_t camera, CameraFaultKind kind) const {
  const double now_s = to_seconds(trigger_.time_since_epoch());
  return std::any_of(setup_.faults.begin(), setup_.faults.end(), [&](const CameraFault& fault) {
    return fault.camera == camera && fault.kind == kind && fault.from_s <= now_s &&
           now_s < fault.to_s;
  });
}

// [0, 1), one number for every camera, tick and purpose.
double SimFrameGrabber::chance(std::size_t camera, std::uint64_t purpose) const {
  return unit_interval(mix(mix(mix(setup_.seed, purpose), camera), tick_));
}

void SimFrameGrabber::show(std::size_t camera) {
  const bool first = shown_[camera].pixels().empty();
  if (!first && has_fault(camera, CameraFaultKind::stuck)) return;
  shown_[camera] = rendered_[camera];
  if (!first && has_fault(camera, CameraFaultKind::torn)) tear(camera);
}

void SimFrameGrabber::tear(std::size_t camera) {
  GreyImage& image = shown_[camera];
  const double share = 0.25 + 0.5 * chance(camera, kTear);
  for (int y = static_cast<int>(share * image.height_px()); y < image.height_px(); ++y) {
    for (int x = 0; x < image.width_px(); ++x) image.at(x, y) = before_[camera].at(x, y);
  }
}

SimFrameGrabber::Fate SimFrameGrabber::fate_of(std::size_t camera) const {
  if (has_fault(camera, CameraFaultKind::dead)) return Fate::dead;
  return chance(camera, kDrop) < setup_.model.drop_share ? Fate::dropped : Fate::arrives;
}

Time SimFrameGrabber::arrival_of(std::size_t camera) const {
  const double exposed_s = to_seconds(settings_[camera].now.exposure);
  double after_s = 0.5 * (exposed_s + setup_.cameras[camera].readout_s) + setup_.model.latency_s +
                   setup_.model.jitter_s * chance(camera, kJitter);
  if (has_fault(camera, CameraFaultKind::late)) after_s += kLate_s;
  return trigger_ + from_seconds(after_s);
}

void SimFrameGrabber::do_trigger(Time /*now*/) {
  on_the_way_ = CameraSet{};
  set_.delivered = CameraSet{};
  for (std::size_t i = 0; i < setup_.cameras.size(); ++i) {
    hal::Frame& frame = set_.frames[i];
    frame.image = view(shown_[i]);
    frame.mid_exposure = trigger_;
    ++frame.sequence;
    ++counts_.triggered;
    if (prepared_ && fates_[i] == Fate::arrives) {
      on_the_way_.insert(i);
    } else {
      ++(prepared_ && fates_[i] == Fate::dead ? counts_.dead : counts_.dropped);
    }
  }
  prepared_ = false;
}

const hal::FrameSet& SimFrameGrabber::do_await(CameraSet expected, Time deadline) {
  Time last = clock_.now();
  set_.delivered = CameraSet{};
  for (std::size_t i = 0; i < setup_.cameras.size(); ++i) {
    const bool on_the_way = on_the_way_.contains(i);
    if (!expected.contains(i)) {
      if (on_the_way) ++counts_.unasked;
    } else if (on_the_way && arrivals_[i] <= deadline) {
      set_.delivered.insert(i);
      ++counts_.delivered;
      last = std::max(last, arrivals_[i]);
    } else {
      if (on_the_way) ++counts_.late;
      last = std::max(last, deadline);
    }
  }
  on_the_way_ = CameraSet{};
  set_delivered_ = set_.delivered;
  clock_.jump_to(last);
  return set_;
}

bool SimFrameGrabber::do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) {
  const double exposure_s = to_seconds(settings.exposure);
  const bool possible = camera < setup_.cameras.size() && exposure_s > 0.0 &&
                        exposure_s <= kLongestExposure_s && settings.gain > 0.0 &&
                        std::isfinite(settings.gain);
  if (!possible) return false;
  // tick_ is one past the tick that is going on.
  const std::uint64_t tick = (tick_ == 0 ? 0 : tick_ - 1) + kSettingsDelay_ticks;
  settings_[camera].wanted[tick % 2] = {settings, tick, true};
  return true;
}

}  // namespace dottrack::host_sim
