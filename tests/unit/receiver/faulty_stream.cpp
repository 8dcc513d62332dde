#include "tests/unit/receiver/faulty_stream.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dottrack::receiver_test {
namespace {

dottrack_settings strict_settings() {
  dottrack_settings settings = dottrack_default_settings();
  settings.age_limit_us = 40'000;  // 20 ms are usual
  settings.group_timeout_us = 30'000;
  return settings;
}

constexpr std::uint64_t kDelayUs = 25'000;
constexpr std::uint64_t kAfterTimeoutUs = 31'000;

bool same_pose(const dottrack_pose& pose, const Group& group) {
  double error = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    error += std::abs(pose.position_m[i] - group.position[i] * 0.0001);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    error += std::abs(pose.orientation_wxyz[i] - group.orientation[i] * 0.000031);
  }
  return pose.sequence == group.sequence && pose.valid && error < 1e-3;
}

}  // namespace

FaultyStream::FaultyStream(std::uint64_t seed, bool fd)
    : random_(seed), listener_(strict_settings()) {
  unit_.shape.fd = fd;
}

FaultyStream::Sent FaultyStream::make() {
  const Group base = unit_.next();
  Group group = random_group(random_, unit_.shape.fd);
  group.sequence = base.sequence;
  group.capture_us = base.capture_us;
  group.age = base.age;
  if (!group.valid) group.orientation = {0, 32258, 0, 0};
  if (!group.valid) group.position = {1, 2, 3};
  group.valid = true;
  group.dots_follow = std::min<std::uint8_t>(group.dots_follow, 3);
  fresh_not_yet_[group.capture_us] = group;
  while (fresh_not_yet_.size() > 8) fresh_not_yet_.erase(fresh_not_yet_.begin());
  return {group, frames_of(group), unit_.arrival_us()};
}

void FaultyStream::deliver(const dottrack_frame& frame, std::uint64_t arrival_us) {
  if (listener_.push(frame, arrival_us) != DOTTRACK_FRESH) return;
  const auto found = fresh_not_yet_.find(listener_.pose().capture_us);
  const bool right = found != fresh_not_yet_.end() && same_pose(listener_.pose(), found->second);
  if (right) {
    fresh_not_yet_.erase(found);  // no pose is fresh twice
  } else {
    ++wrong_poses_;
  }
}

void FaultyStream::deliver(const Sent& sent) {
  for (const dottrack_frame& frame : sent.frames) deliver(frame, sent.arrival_us);
}

void FaultyStream::expect_given_up(std::size_t frames_left) {
  ++(frames_left > 0 ? expected_.incomplete : expected_.lost_groups);
}

void FaultyStream::lose_frame(Sent sent) {
  sent.frames.erase(sent.frames.begin() + static_cast<std::ptrdiff_t>(any(sent.frames.size())));
  deliver(sent);
  expect_given_up(sent.frames.size());
}

void FaultyStream::double_frame(const Sent& sent) {
  const std::size_t which = any(sent.frames.size());
  const std::size_t when = which + any(sent.frames.size() - which);
  for (std::size_t i = 0; i < sent.frames.size(); ++i) {
    deliver(sent.frames[i], sent.arrival_us);
    if (i == when) deliver(sent.frames[which], sent.arrival_us);
  }
  ++expected_.fresh;
  ++expected_.repeated_frames;
}

void FaultyStream::deliver_last_late(Sent sent) {
  const dottrack_frame last = sent.frames.back();
  sent.frames.pop_back();
  deliver(sent);
  expect_given_up(sent.frames.size());
  const Sent next = make();
  for (std::size_t i = 0; i < next.frames.size(); ++i) {
    deliver(next.frames[i], next.arrival_us);
    if (i == 0) deliver(last, next.arrival_us);
  }
  ++expected_.late_frames;
  ++expected_.fresh;
}

void FaultyStream::swap_with_next(const Sent& sent) {
  const Sent next = make();
  deliver(next);
  for (const dottrack_frame& frame : sent.frames) deliver(frame, next.arrival_us);
  ++expected_.fresh;
  ++expected_.lost_groups;
  expected_.late_frames += sent.frames.size();
}

void FaultyStream::damage(Sent sent, Fault fault) {
  dottrack_frame& frame = sent.frames[any(sent.frames.size())];
  const bool is_fd_pose = frame.length == 64;
  if (fault == Fault::truncated) {
    frame.length = static_cast<std::uint8_t>(any(frame.length));
  } else if (fault == Fault::flipped_bit) {
    flip_bit(frame, static_cast<unsigned>(any(frame.length * 8U)));
  } else {
    const std::uint32_t own = frame.id - DOTTRACK_DEFAULT_BASE_ID;
    frame.id = DOTTRACK_DEFAULT_BASE_ID + (is_fd_pose ? kStatus : own == kTime ? kQuality : kTime);
  }
  deliver(sent);
  ++expected_.corrupted;
  expect_given_up(sent.frames.size() - 1);
}

void FaultyStream::step(Fault fault) {
  ++injected_[static_cast<std::size_t>(fault)];
  Sent sent = make();
  switch (fault) {
    case Fault::lost_group:
      ++expected_.lost_groups;
      return;
    case Fault::lost_frame:
      return lose_frame(std::move(sent));
    case Fault::doubled_frame:
      return double_frame(sent);
    case Fault::doubled_group:
      deliver(sent);
      deliver(sent);
      ++expected_.fresh;
      expected_.repeated_frames += sent.frames.size();
      return;
    case Fault::repeated_later:
      deliver(sent);
      sent.arrival_us += kAfterTimeoutUs;
      deliver(sent);
      ++expected_.fresh;
      ++expected_.repeated_groups;
      return;
    case Fault::last_frame_late:
      return deliver_last_late(std::move(sent));
    case Fault::swapped_groups:
      return swap_with_next(sent);
    case Fault::delayed:
      sent.arrival_us += kDelayUs;
      deliver(sent);
      ++expected_.stale;
      return;
    case Fault::truncated:
    case Fault::flipped_bit:
    case Fault::wrong_identifier:
      return damage(std::move(sent), fault);
    case Fault::shuffled:
      std::shuffle(sent.frames.begin(), sent.frames.end(), random_);
      break;
    case Fault::none:
      break;
  }
  deliver(sent);
  ++expected_.fresh;
}

void FaultyStream::run(unsigned groups) {
  for (unsigned i = 0; i < groups; ++i) {
    step(Fault::none);
    step(static_cast<Fault>(any(kFaults)));
    step(Fault::none);
  }
}

}  // namespace dottrack::receiver_test
