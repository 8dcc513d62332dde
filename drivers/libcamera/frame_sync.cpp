#include "drivers/libcamera/frame_sync.h"

#include <algorithm>

namespace dottrack::drivers {
namespace {

// Parts of a period, and periods.
constexpr int kTogether = 4;       // a quarter: frames of one exposure are this close
constexpr int kSettling = 8;       // an eighth: after it no more frames of a group are on their way
constexpr int kPeriodsToLive = 3;  // a free-running frame that waited longer is of no use

bool holds(CameraSet all, CameraSet some) {
  return (some.bits() & ~all.bits()) == 0;
}

bool better(CameraSet cameras, Time first, CameraSet than, Time than_first) {
  if (cameras.size() != than.size()) return cameras.size() > than.size();
  return first > than_first;
}

}  // namespace

template <class Reject>
void FrameSync::give_back_if(std::size_t camera, Reject reject) {
  auto& queue = waiting_[camera];
  for (std::size_t i = 0; i < queue.size();) {
    if (!reject(queue[i].frame)) {
      ++i;
      continue;
    }
    late_.give_back_late(camera, queue[i].frame);
    queue.erase(queue.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

bool FrameSync::is_past(const Arrival& frame) const {
  return frame.mid_exposure < earliest_;
}

void FrameSync::begin(Time now) {
  const Time oldest = triggered_ ? now - period_ / kTogether : now - kPeriodsToLive * period_;
  earliest_ = std::max(earliest_, oldest);
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    give_back_if(camera, [&](const Arrival& frame) { return is_past(frame); });
  }
}

void FrameSync::add(std::size_t camera, const Arrival& frame, Time seen) {
  // A stamp from the future would make every true one look old.
  if (is_past(frame) || frame.mid_exposure > seen + period_) {
    late_.give_back_late(camera, frame);
    return;
  }
  auto& queue = waiting_[camera];
  if (queue.size() == kMaxWaiting) {
    late_.give_back_late(camera, queue.front().frame);
    queue.erase(queue.begin());
  }
  queue.push_back({frame, seen});
}

// The newest frame of each camera that was exposed within a quarter of a period from `first` on.
FrameSync::Group FrameSync::group_from(Time first, CameraSet expected) const {
  Group group{.first = first, .seen = Time::min(), .cameras = {}, .at = {}};
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!expected.contains(camera)) continue;
    const auto& queue = waiting_[camera];
    Time newest = Time::min();
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Time at = queue[i].frame.mid_exposure;
      if (at < first || at > first + period_ / kTogether || at < newest) continue;
      newest = at;
      group.at[camera] = static_cast<std::uint8_t>(i);
      group.seen = std::max(group.seen, queue[i].seen);
      group.cameras.insert(camera);
    }
  }
  return group;
}

// The first frame of each camera: what is waiting was exposed after the trigger.
FrameSync::Group FrameSync::triggered_group(CameraSet expected) const {
  Group group;
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (expected.contains(camera) && !waiting_[camera].empty()) group.cameras.insert(camera);
  }
  return group;
}

Time FrameSync::newest_exposure(CameraSet expected) const {
  Time newest = Time::min();
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!expected.contains(camera)) continue;
    for (const Waiting& waiting : waiting_[camera]) {
      newest = std::max(newest, waiting.frame.mid_exposure);
    }
  }
  return newest;
}

// The newest complete group, unless the cameras are more than an exposure ahead of it.
std::optional<FrameSync::Group> FrameSync::complete_group(CameraSet expected,
                                                          CameraSet wanted) const {
  if (triggered_) {
    const Group group = triggered_group(expected);
    if (!holds(group.cameras, wanted)) return std::nullopt;
    return group;
  }
  std::optional<Group> newest;
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!expected.contains(camera)) continue;
    for (const Waiting& waiting : waiting_[camera]) {
      if (newest && waiting.frame.mid_exposure <= newest->first) continue;
      const Group group = group_from(waiting.frame.mid_exposure, expected);
      if (holds(group.cameras, wanted)) newest = group;
    }
  }
  if (newest && newest_exposure(expected) - newest->first > period_ * 3 / 2) return std::nullopt;
  return newest;
}

std::optional<FrameSync::Group> FrameSync::best_group(CameraSet expected, Time now) const {
  if (triggered_) return triggered_group(expected);
  std::optional<Group> best;
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!expected.contains(camera)) continue;
    for (const Waiting& waiting : waiting_[camera]) {
      const Group group = group_from(waiting.frame.mid_exposure, expected);
      if (now - group.seen < period_ / kSettling) continue;
      if (!best || better(group.cameras, group.first, best->cameras, best->first)) best = group;
    }
  }
  return best;
}

bool FrameSync::complete(CameraSet expected, CameraSet wanted) const {
  return wanted.empty() || complete_group(expected, wanted).has_value();
}

CameraSet FrameSync::take(CameraSet expected, CameraSet wanted, Time now) {
  std::optional<Group> group = complete_group(expected, wanted);
  if (!group) group = best_group(expected, now);
  if (!group || group->cameras.empty()) return {};
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!group->cameras.contains(camera)) continue;
    auto& queue = waiting_[camera];
    taken_[camera] = queue[group->at[camera]].frame;
    queue.erase(queue.begin() + group->at[camera]);
  }
  if (triggered_) return group->cameras;
  // What is still to come of this exposure belongs to no other: a group's width, and half of one
  // for stamps that waver.
  earliest_ = std::max(earliest_, group->first + period_ * 3 / (2 * kTogether));
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    give_back_if(camera, [&](const Arrival& frame) { return is_past(frame); });
  }
  return group->cameras;
}

}  // namespace dottrack::drivers
