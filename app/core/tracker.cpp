#include "app/core/tracker.h"

#include <algorithm>

#include "app/core/acquisition/acquisition.h"
#include "app/core/estimation/motion.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/band.h"
#include "app/core/image/identify.h"
#include "app/core/stale_images.h"
#include "app/core/tracking/follow.h"

namespace dottrack::core {
namespace {

using Frames = std::array<CameraFrame, kMaxCameras>;
using AllOptics = std::array<geometry::Optics, kMaxCameras>;

bool usable(const CameraFrame& frame, const Camera& camera) {
  return frame.delivered && !frame.image.empty() && frame.image.width_px == camera.width_px &&
         frame.image.height_px == camera.height_px;
}

// Mean over the delivered frames, without overflow.
Time mean_capture_time(std::span<const CameraFrame> frames) {
  Time first{};
  Duration sum{};
  std::int64_t n = 0;
  for (const CameraFrame& frame : frames) {
    if (!frame.delivered) continue;
    if (n == 0) first = frame.mid_exposure;
    sum += frame.mid_exposure - first;
    ++n;
  }
  return n == 0 ? first : first + sum / n;
}

// The sign of a quaternion means nothing; from tick to tick it stays the same.
void keep_sign(const Eigen::Quaterniond& previous, Eigen::Quaterniond& orientation) {
  if (previous.dot(orientation) < 0.0) orientation.coeffs() *= -1.0;
}

}  // namespace

struct Tracker::Memory {
  explicit Memory(const Rig& r)
      : rig(r), acquisition(rig, optics), follower(rig, optics, identifier) {
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      const Camera& camera = rig.cameras[i];
      optics[i] = geometry::Optics(camera.model, camera.width_px, camera.height_px);
      gates[i] = acquisition::acquisition_gate(camera, optics[i], rig.target);
    }
    for (std::size_t i = 0; i < kMaxCameras; ++i) considered_of[i] = &considered[i];
  }

  void take_frames(const Frames& given);
  void identify();
  void acquire();
  void confirm(const Pose& pose);
  void follow();
  void accept(const tracking::FollowResult& followed);
  void refuse(Reason reason);

  Rig rig;
  AllOptics optics;
  image::Identifier identifier;
  acquisition::Acquisition acquisition;
  tracking::Follower follower;
  std::array<image::RegionGate, kMaxCameras> gates{};
  std::array<image::Regions, kMaxCameras> candidates;  // of the whole images
  std::array<image::Regions, kMaxCameras> considered;  // in the dots' windows
  std::array<image::Regions*, kMaxCameras> considered_of{};
  Frames frames{};
  StaleImages stale_images;
  CameraSet delivered;
  bool started = false;
  bool acquired_last = true;  // the last tick looked at whole images
  State state = State::acquiring;
  Pose pose;             // the last one found
  Time pose_time{};      // when it held
  bool follows = false;  // it is of the tick before and of the same lock
  double false_lock_probability = 1.0;
  TickResult result;
};

void Tracker::Memory::take_frames(const Frames& given) {
  frames = given;
  delivered = CameraSet{};
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    frames[i].delivered = i < rig.cameras.size() && usable(given[i], rig.cameras[i]);
  }
  const CameraSet stale = stale_images.update(frames);
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    result.cameras[i].stale = stale.contains(i);
    frames[i].delivered = frames[i].delivered && !stale.contains(i);
    if (frames[i].delivered) delivered.insert(i);
    result.cameras[i].delivered = frames[i].delivered;
  }
  result.capture_time = mean_capture_time(frames);
}

// 3.1.2
void Tracker::Memory::identify() {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    candidates[i].clear();
    if (!frames[i].delivered) continue;
    const image::IdentifyCounts counts = identifier.identify(
        frames[i].image, image::band_of(rig.cameras[i]), gates[i], candidates[i]);
    CameraTick& camera = result.cameras[i];
    camera.components = counts.components;
    camera.regions = counts.accepted;
    camera.overflow = counts.overflow_runs + counts.overflow_regions > 0;
  }
}

// 3.1.3 to 3.1.5
void Tracker::Memory::acquire() {
  acquired_last = true;
  identify();
  std::array<const image::Regions*, kMaxCameras> regions{};
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) regions[i] = &candidates[i];
  const acquisition::AcquisitionResult acquired = acquisition.acquire(regions);
  result.acquisition = acquired.counts;
  if (acquired.reason == Reason::none) {
    confirm(acquired.pose);
  } else {
    refuse(acquired.reason);
  }
}

// A single run of tracking on the same images rejects the acquisition if it rejects them (3.1.5).
void Tracker::Memory::confirm(const Pose& acquired) {
  const tracking::FollowResult& followed = follower.follow(frames, acquired, considered_of);
  if (followed.reason != Reason::none) {
    refuse(Reason::not_confirmed);
    return;
  }
  ++result.reset_count;
  follows = false;
  // Of as many chance matches as are expected, at most so many exist (Markov).
  false_lock_probability = result.acquisition.false_lock_probability;
  accept(followed);
}

// 3.2
void Tracker::Memory::follow() {
  acquired_last = false;
  const tracking::FollowResult& followed = follower.follow(frames, pose, considered_of);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    result.cameras[i].regions = static_cast<std::uint32_t>(considered[i].size());
  }
  if (followed.reason == Reason::none) {
    accept(followed);
  } else {
    refuse(followed.reason);
  }
}

void Tracker::Memory::accept(const tracking::FollowResult& followed) {
  state = State::tracking;
  result.reason = Reason::none;
  result.has_pose = true;
  result.pose = followed.pose;
  keep_sign(pose.orientation, result.pose.orientation);
  if (follows) {
    result.motion = estimation::motion_between(pose, pose_time, result.pose, result.capture_time);
  }
  result.false_lock_probability = false_lock_probability;
  pose = result.pose;
  pose_time = result.capture_time;
  follows = true;
  result.ticks_lost = 0;
  result.dots = followed.dots;
  result.dots_used = followed.dots_used;
  result.cameras_used = followed.cameras_used;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    result.cameras[i].used = followed.cameras_used.contains(i);
  }
}

void Tracker::Memory::refuse(Reason reason) {
  result.reason = reason;
  follows = false;
  ++result.ticks_lost;
  if (result.ticks_lost >= static_cast<std::uint32_t>(rig.limits.lost_after_ticks)) {
    state = State::acquiring;
  }
}

Tracker::Tracker(const Rig& rig) : memory_(std::make_unique<Memory>(rig)) {}
Tracker::~Tracker() = default;

const TickResult& Tracker::step(const Frames& frames) {
  Memory& m = *memory_;
  TickResult fresh;
  fresh.tick = m.started ? m.result.tick + 1 : 0;
  fresh.reset_count = m.result.reset_count;
  fresh.ticks_lost = m.result.ticks_lost;
  m.result = fresh;
  m.started = true;
  m.take_frames(frames);
  if (m.delivered.size() < 2) {
    m.refuse(m.delivered.empty() ? Reason::no_frames : Reason::too_few_cameras);
  } else if (m.state == State::acquiring) {
    m.acquire();
  } else {
    m.follow();
  }
  m.result.state = m.state;
  return m.result;
}

void Tracker::forget() {
  memory_->state = State::acquiring;
}

std::span<const image::Region> Tracker::regions(std::size_t camera) const {
  const image::Regions& regions =
      memory_->acquired_last ? memory_->candidates[camera] : memory_->considered[camera];
  return {regions.data(), regions.size()};
}

std::size_t Tracker::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory) + memory_->identifier.footprint_bytes() +
         memory_->acquisition.footprint_bytes();
}

}  // namespace dottrack::core
