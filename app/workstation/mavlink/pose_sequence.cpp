#include "app/workstation/mavlink/pose_sequence.h"

#include <limits>

namespace dottrack::workstation {
namespace {

constexpr std::uint64_t kHeartbeatPeriod_us = 1'000'000;

std::uint64_t exposure_us(const dottrack_pose& pose) {
  return pose.arrival_us > pose.age_us ? pose.arrival_us - pose.age_us : 0;
}

}  // namespace

bool can_be_handed_over(const dottrack_pose& pose) {
  return pose.valid && pose.age_us != std::numeric_limits<std::uint32_t>::max();
}

std::span<const MavlinkFrame> PoseSequence::frames_of(const dottrack_pose& pose) {
  count_ = 0;
  follow_resets(pose);
  if (heartbeat_due(pose.arrival_us)) append(heartbeat());
  if (can_be_handed_over(pose)) {
    const VisionSample sample{.time_us = exposure_us(pose),
                              .pose = ned_pose(pose),
                              .reset_counter = reset_counter_,
                              .quality = quality_percent(pose.false_lock_probability)};
    if (options_.vision_position_estimate) append(vision_position_estimate(sample));
    if (options_.odometry) append(odometry(sample));
  }
  return std::span(frames_).first(count_);
}

void PoseSequence::append(const MavlinkMessage& message) {
  frames_[count_++] =
      framed(message,
             {.sequence = sequence_++, .system = options_.system, .component = options_.component});
}

bool PoseSequence::heartbeat_due(std::uint64_t now_us) {
  // Time that goes back is a log played again: it begins anew.
  const bool due =
      !heartbeat_us_ || now_us < *heartbeat_us_ || now_us - *heartbeat_us_ >= kHeartbeatPeriod_us;
  if (due) heartbeat_us_ = now_us;
  return due;
}

void PoseSequence::follow_resets(const dottrack_pose& pose) {
  if (!unit_resets_) {
    reset_counter_ = pose.reset_count;
  } else if (pose.restarted) {
    // The unit counts from the beginning again, perhaps to the same number.
    ++reset_counter_;
  } else {
    reset_counter_ = static_cast<std::uint8_t>(reset_counter_ + pose.reset_count - *unit_resets_);
  }
  unit_resets_ = pose.reset_count;
}

}  // namespace dottrack::workstation
