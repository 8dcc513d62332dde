#pragma once
// A unit that sends groups, and a receiver with what it said.

#include <cstdint>
#include <map>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "tests/unit/receiver/frame_builder.h"

namespace dottrack::receiver_test {

// Groups at 30 Hz: the unit's clock is a quarter of a second behind ours.
class Unit {
 public:
  static constexpr std::uint64_t kPeriodUs = 33333;
  static constexpr std::uint64_t kOffsetUs = 250000;

  Group next() {
    Group group = shape;
    group.sequence = sequence++;
    group.capture_us = capture_us & kClockMask;
    capture_us += kPeriodUs;
    return group;
  }
  // When a group arrives: Age after the middle of its exposure and 1 ms on the bus.
  static std::uint64_t arrival_us(const Group& group) {
    return group.capture_us + kOffsetUs + group.age * 100U + 1000U;
  }
  // Of the group made last.
  std::uint64_t arrival_us() const {
    return capture_us - kPeriodUs + kOffsetUs + shape.age * 100U + 1000U;
  }

  Group shape;
  std::uint8_t sequence = 0;
  std::uint64_t capture_us = 5'000'000;
};

class Listener {
 public:
  Listener() { dottrack_receiver_init(&receiver_, nullptr); }
  explicit Listener(const dottrack_settings& settings) {
    dottrack_receiver_init(&receiver_, &settings);
  }

  dottrack_verdict push(const dottrack_frame& frame, std::uint64_t arrival_us) {
    const dottrack_verdict verdict = dottrack_receiver_push(&receiver_, &frame, arrival_us, &pose_);
    ++verdicts_[verdict];
    return verdict;
  }
  // The verdict of the last frame.
  dottrack_verdict push(const Frames& frames, std::uint64_t arrival_us) {
    dottrack_verdict verdict = DOTTRACK_FOREIGN;
    for (const dottrack_frame& frame : frames) verdict = push(frame, arrival_us);
    return verdict;
  }
  dottrack_verdict push(const Group& group, std::uint64_t arrival_us) {
    return push(frames_of(group), arrival_us);
  }
  // When it is due, or later.
  dottrack_verdict take(const Group& group, std::uint64_t delay_us = 0) {
    return push(group, Unit::arrival_us(group) + delay_us);
  }
  dottrack_verdict poll(std::uint64_t now_us) { return dottrack_receiver_poll(&receiver_, now_us); }

  const dottrack_pose& pose() const { return pose_; }
  const dottrack_counts& counts() const { return receiver_.counts; }
  const dottrack_unit& unit() const { return receiver_.unit; }
  const dottrack_light& light(unsigned camera) const { return receiver_.light[camera]; }
  std::uint64_t verdicts(dottrack_verdict verdict) const {
    const auto found = verdicts_.find(verdict);
    return found == verdicts_.end() ? 0 : found->second;
  }

 private:
  dottrack_receiver receiver_{};
  dottrack_pose pose_{};
  std::map<dottrack_verdict, std::uint64_t> verdicts_;
};

}  // namespace dottrack::receiver_test
