#include "tests/board/harness/pose_log.h"

#include <algorithm>

#include "app/core/protocol/receiver_frame.h"
#include "drivers/candump/candump_line.h"

namespace dottrack::board {
namespace {

dottrack_settings patient_settings() {
  dottrack_settings settings = dottrack_default_settings();
  settings.age_limit_us = PoseLog::kAgeLimit_us;
  settings.group_timeout_us = PoseLog::kGroupTimeout_us;
  return settings;
}

std::uint64_t groups(const dottrack_counts& counts) {
  return counts.fresh + counts.stale;
}

}  // namespace

PoseLog::PoseLog() {
  const dottrack_settings settings = patient_settings();
  dottrack_receiver_init(&receiver_, &settings);
}

void PoseLog::take(const LoggedLine& line) {
  const auto logged = drivers::parse_candump_line(line.text);
  if (!logged) return;
  const dottrack_frame frame = protocol::to_receiver(logged->frame);
  const auto arrival = std::chrono::floor<std::chrono::microseconds>(line.received);
  const auto arrival_us = static_cast<std::uint64_t>(arrival.time_since_epoch().count());
  const std::lock_guard lock(mutex_);
  const std::uint64_t before = groups(receiver_.counts);
  ReceivedPose pose;
  const auto verdict = dottrack_receiver_push(&receiver_, &frame, arrival_us, &pose.message);
  if (groups(receiver_.counts) == before) return;
  pose.fresh = verdict == DOTTRACK_FRESH;
  pose.received = line.received;
  pose.boot = boot_;
  poses_.push_back(pose);
  changed_.notify_all();
}

void PoseLog::start_boot() {
  const std::lock_guard lock(mutex_);
  ++boot_;
}

std::size_t PoseLog::size() const {
  const std::lock_guard lock(mutex_);
  return poses_.size();
}

std::vector<ReceivedPose> PoseLog::from(std::size_t first) const {
  const std::lock_guard lock(mutex_);
  if (first >= poses_.size()) return {};
  return {poses_.begin() + static_cast<std::ptrdiff_t>(first), poses_.end()};
}

dottrack_counts PoseLog::counts() const {
  const std::lock_guard lock(mutex_);
  return receiver_.counts;
}

dottrack_unit PoseLog::unit() const {
  const std::lock_guard lock(mutex_);
  return receiver_.unit;
}

std::optional<std::size_t> PoseLog::wait_for(const Fits& fits, std::size_t count, std::size_t first,
                                             Duration patience) const {
  std::unique_lock lock(mutex_);
  std::optional<std::size_t> found;
  std::size_t next = first;
  std::size_t fitting = 0;
  changed_.wait_for(lock, patience, [&] {
    for (; next < poses_.size() && !found; ++next) {
      if (fits(poses_[next]) && ++fitting == count) found = next;
    }
    return found.has_value();
  });
  return found;
}

}  // namespace dottrack::board
