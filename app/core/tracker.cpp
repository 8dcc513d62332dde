#include "app/core/tracker.h"

#include <algorithm>

#include "app/core/acquisition/gathered_evidence.h"
#include "app/core/estimation/same_place.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/searcher.h"
#include "app/core/stale_images.h"
#include "app/core/tracking/camera_watch.h"
#include "app/core/tracking/follow.h"
#include "app/core/tracking/motion_estimator.h"
#include "app/core/tracking/shift_evidence.h"

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

// A better explanation elsewhere must show in so many searches one after another, each time leaving
// the present lock less probable than this, before it takes its place: twins do not take turns.
constexpr int kBetterSearches = 2;
constexpr double kDoubtOfBetter = 1e-4;

constexpr int kViewsThatShowAMistake = 4;  // eight coordinates; a pose has six

// What tracking saw of the dots, as witnesses of its pose.
acquisition::Witnesses witnesses_of(const tracking::FollowResult& followed) {
  acquisition::Witnesses witnesses;
  for (std::size_t dot = 0; dot < followed.dots.size(); ++dot) {
    const DotState& state = followed.dots[dot];
    if (!state.located) continue;
    const double variance = state.position_sigma_m * state.position_sigma_m / 3.0;
    witnesses.push_back({.dot = dot,
                         .position_m = state.position_m,
                         .covariance_m2 = variance * Eigen::Matrix3d::Identity(),
                         .diameter_m = state.diameter_m,
                         .views = state.cameras.size()});
  }
  return witnesses;
}

// The sign of a quaternion means nothing; from tick to tick it stays the same.
void keep_sign(const Eigen::Quaterniond& previous, Eigen::Quaterniond& orientation) {
  if (previous.dot(orientation) < 0.0) orientation.coeffs() *= -1.0;
}

}  // namespace

struct Tracker::Memory {
  explicit Memory(const Rig& r)
      : rig(r),
        searcher(rig, optics_of(rig, optics), identifier),
        follower(rig, optics, identifier),
        motion(rig),
        camera_watch(rig.cameras.size()),
        gathered(rig.target, rig.limits) {
    for (std::size_t i = 0; i < kMaxCameras; ++i) considered_of[i] = &considered[i];
  }

  static AllOptics& optics_of(const Rig& rig, AllOptics& optics) {
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      const Camera& camera = rig.cameras[i];
      optics[i] = geometry::Optics(camera.model, camera.width_px, camera.height_px);
    }
    return optics;
  }

  void take_frames(const Frames& given);
  Reason acquire();
  Reason judge_candidate(Reason doubt);
  void follow();
  bool is_out_of_reach(const tracking::FollowResult& followed) const;
  void watch(const tracking::FollowResult& followed);
  void look_for_moved_cameras(const tracking::FollowResult& followed);
  void report_cameras();
  bool is_better_elsewhere();
  void lock(const tracking::FollowResult& followed, double probability_of_false);
  void accept(const tracking::FollowResult& followed);
  void filter();
  void refuse(Reason reason);

  Rig rig;
  AllOptics optics;
  image::Identifier identifier;
  Searcher searcher;
  tracking::Follower follower;
  tracking::MotionEstimator motion;
  tracking::CameraWatch camera_watch;
  estimation::DotSpread dot_spread;
  acquisition::GatheredEvidence gathered;
  std::array<image::Regions, kMaxCameras> considered;  // in the dots' windows
  std::array<image::Regions*, kMaxCameras> considered_of{};
  Frames frames{};
  Frames trusted{};  // those of them that a pose may rest on
  StaleImages stale_images;
  CameraSet delivered;  // of the trusted ones
  bool started = false;
  bool searched_last = true;  // the last tick was decided by whole images
  State state = State::acquiring;
  Pose pose;  // the last one found
  double false_lock_probability = 1.0;

  // The lock as it was in the images that the watch looks through.
  bool watching = false;
  Pose watched_pose;
  acquisition::Witnesses watched_witnesses;
  int better_searches = 0;
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
    result.cameras[i].delivered = frames[i].delivered;
  }
  trusted = frames;
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    result.cameras[i].moved = camera_watch.moved().contains(i);
    trusted[i].delivered = frames[i].delivered && !result.cameras[i].moved;
    if (trusted[i].delivered) delivered.insert(i);
  }
  result.capture_time = mean_capture_time(trusted);
}

// 3.1. The reason why there is no lock; none when there is one.
Reason Tracker::Memory::acquire() {
  searched_last = true;
  watching = false;
  const bool ended = searcher.look(trusted, result.capture_time);
  searcher.report(result);
  if (!ended) return Reason::work_budget;
  const Reason reason = searcher.acquisition().result().reason;
  if (reason == Reason::none || reason == Reason::ambiguous) return judge_candidate(reason);
  gathered.miss();
  return reason;
}

// A single run of tracking on the present images rejects the candidate if it rejects them (3.1.5).
// Then the evidence of all ticks so far decides whether it is a lock.
Reason Tracker::Memory::judge_candidate(Reason doubt) {
  const acquisition::CandidateLock& candidate = searcher.acquisition().result().candidate;
  result.has_candidate = true;
  result.candidate = candidate.pose;
  tracking::Expectation expected(candidate.pose);
  expected.dot_spread = dot_spread;
  const tracking::FollowResult& followed =
      follower.follow(frames, expected, considered_of, camera_watch.moved());
  if (followed.reason != Reason::none) {
    gathered.miss();
    return Reason::not_confirmed;
  }
  const double p = gathered.add(candidate, searcher.captured());
  result.acquisition.false_lock_probability = p;
  if (p > rig.limits.max_false_lock_probability) {
    return doubt == Reason::none ? Reason::held_back : doubt;
  }
  lock(followed, p);
  return Reason::none;
}

void Tracker::Memory::lock(const tracking::FollowResult& followed, double probability_of_false) {
  ++result.reset_count;
  motion.stop();
  false_lock_probability = probability_of_false;
  better_searches = 0;
  gathered.forget();
  camera_watch.interrupt();
  accept(followed);
}

// 3.2. Where tracking fails, acquisition may find the target in the same images.
void Tracker::Memory::follow() {
  searched_last = false;
  tracking::Expectation expected = motion.expect(result.capture_time, pose);
  expected.dot_spread = dot_spread;
  const tracking::FollowResult& followed =
      follower.follow(frames, expected, considered_of, camera_watch.moved());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    result.cameras[i].regions = static_cast<std::uint32_t>(considered[i].size());
    result.cameras[i].rejected_ellipse = followed.rejected_ellipse[i];
    result.cameras[i].bloomed = followed.bloomed[i];
  }
  const bool watches = rig.limits.watch_every_ticks > 0;
  const Reason reason = followed.reason;
  if (reason == Reason::none && is_out_of_reach(followed)) {
    refuse(Reason::step_too_large);
  } else if (reason == Reason::none) {
    accept(followed);
    look_for_moved_cameras(followed);
    if (watches) watch(followed);
  } else if (!watches || acquire() != Reason::none) {
    refuse(reason);
  }
}

// So few views have nothing left over that would show a mistake: where the vehicle cannot have come
// by itself they are not believed.
bool Tracker::Memory::is_out_of_reach(const tracking::FollowResult& followed) const {
  return followed.views_used < kViewsThatShowAMistake &&
         !motion.is_reachable(followed.pose, result.capture_time);
}

// Before anything else is followed: the follower remembers its last cycle only.
void Tracker::Memory::look_for_moved_cameras(const tracking::FollowResult& followed) {
  camera_watch.look(tracking::shift_evidence(rig, follower, followed, camera_watch.moved()));
}

void Tracker::Memory::report_cameras() {
  result.rig_disagrees = camera_watch.rig_disagrees();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    result.cameras[i].moved = camera_watch.moved().contains(i);
    result.cameras[i].shift_px = camera_watch.shift_px(i).cast<float>();
  }
}

// Whether the target is not rather elsewhere: the search that acquisition makes, beside tracking.
void Tracker::Memory::watch(const tracking::FollowResult& followed) {
  if (!watching) searcher.give_up();
  if (!searcher.busy()) {
    const auto every = static_cast<std::uint64_t>(rig.limits.watch_every_ticks);
    if (result.tick % every != 0) return;
    watching = true;
    watched_pose = result.pose;
    watched_witnesses = witnesses_of(followed);
  }
  if (!searcher.look(trusted, result.capture_time)) return;
  better_searches = is_better_elsewhere() ? better_searches + 1 : 0;
  if (better_searches < kBetterSearches) return;
  const acquisition::AcquisitionResult& found = searcher.acquisition().result();
  const tracking::FollowResult& there =
      follower.follow(frames, found.candidate.pose, considered_of, camera_watch.moved());
  if (there.reason != Reason::none) return;
  result.relock = Relock::better_elsewhere;
  dot_spread = {};  // it was that of something else
  lock(there, found.counts.false_lock_probability);
}

bool Tracker::Memory::is_better_elsewhere() {
  const acquisition::AcquisitionResult& found = searcher.acquisition().result();
  if (found.reason != Reason::none ||
      found.counts.false_lock_probability > rig.limits.max_false_lock_probability ||
      estimation::same_place(rig.target, found.candidate.pose, watched_pose)) {
    return false;
  }
  const double here =
      searcher.acquisition().log_odds_of_lock(watched_pose, as_span(watched_witnesses));
  return acquisition::false_lock_probability(found.candidate.log_odds, {&here, 1}) <=
         kDoubtOfBetter;
}

void Tracker::Memory::accept(const tracking::FollowResult& followed) {
  state = State::tracking;
  result.reason = Reason::none;
  result.has_pose = true;
  result.pose = followed.pose;
  result.systematic = followed.systematic;
  result.dot_sigma_m = followed.dot_sigma_m;
  dot_spread.take_in(followed.spread);
  keep_sign(pose.orientation, result.pose.orientation);
  filter();
  result.false_lock_probability = false_lock_probability;
  pose = result.pose;
  result.ticks_lost = 0;
  result.dots = followed.dots;
  result.dots_used = followed.dots_used;
  result.views_used = followed.views_used;
  result.views_left_out = followed.views_left_out;
  result.cameras_used = followed.cameras_used;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    result.cameras[i].used = followed.cameras_used.contains(i);
  }
}

// A pose that the vehicle cannot have reached is a reset, never a smear.
void Tracker::Memory::filter() {
  if (!motion.take_in(trusted, follower.fit(), result.capture_time)) {
    motion.start(follower.fit(), result.capture_time);
    result.relock = Relock::jumped;
    ++result.reset_count;
  }
  result.filtered = motion.filtered(result.capture_time);
  keep_sign(pose.orientation, result.filtered.pose.orientation);
}

void Tracker::Memory::refuse(Reason reason) {
  result.reason = reason;
  better_searches = 0;
  ++result.ticks_lost;
  camera_watch.look({});
  const Time now = result.capture_time;
  const bool coasting = state == State::tracking && motion.may_coast(now);
  if (coasting) {
    result.filtered = motion.filtered(now);
    result.filtered.coasting = true;
    keep_sign(pose.orientation, result.filtered.pose.orientation);
    return;
  }
  if (result.ticks_lost >= static_cast<std::uint32_t>(rig.limits.lost_after_ticks)) {
    state = State::acquiring;
    motion.stop();
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
    const Reason reason = m.acquire();
    if (reason != Reason::none) m.refuse(reason);
  } else {
    m.follow();
  }
  m.result.state = m.state;
  m.report_cameras();
  return m.result;
}

FilteredPose Tracker::predicted(Time at) const {
  FilteredPose pose = memory_->motion.filtered(at);
  keep_sign(memory_->pose.orientation, pose.pose.orientation);
  return pose;
}

void Tracker::forget() {
  memory_->state = State::acquiring;
  memory_->searcher.give_up();
  memory_->gathered.forget();
  memory_->motion.stop();
}

void Tracker::readmit_cameras() {
  memory_->camera_watch.readmit();
}

std::span<const image::Region> Tracker::regions(std::size_t camera) const {
  const image::Regions& regions =
      memory_->searched_last ? memory_->searcher.regions(camera) : memory_->considered[camera];
  return {regions.data(), regions.size()};
}

std::size_t Tracker::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory) + memory_->identifier.footprint_bytes() +
         memory_->searcher.footprint_bytes();
}

}  // namespace dottrack::core
