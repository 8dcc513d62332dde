#pragma once
// A long stream of groups with faults put in by the dozen, and what a receiver must have counted.

#include <array>
#include <cstdint>
#include <map>
#include <random>

#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {

enum class Fault : std::uint8_t {
  none,
  lost_group,
  lost_frame,
  doubled_frame,
  doubled_group,
  repeated_later,  // the whole group once more, when its timeout is over
  shuffled,        // no fault: any order within a group will do
  last_frame_late,
  swapped_groups,
  delayed,
  truncated,
  flipped_bit,
  wrong_identifier,
};
inline constexpr std::size_t kFaults = 13;

class FaultyStream {
 public:
  FaultyStream(std::uint64_t seed, bool fd);

  // A fault in one group of three, a group without between any two.
  void run(unsigned groups);

  const Listener& listener() const { return listener_; }
  const dottrack_counts& expected() const { return expected_; }
  const std::array<std::uint64_t, kFaults>& injected() const { return injected_; }
  std::uint64_t wrong_poses() const { return wrong_poses_; }

 private:
  struct Sent {
    Group group;
    Frames frames;
    std::uint64_t arrival_us = 0;
  };

  Sent make();
  void deliver(const dottrack_frame& frame, std::uint64_t arrival_us);
  void deliver(const Sent& sent);
  void step(Fault fault);
  void lose_frame(Sent sent);
  void double_frame(const Sent& sent);
  void deliver_last_late(Sent sent);
  void swap_with_next(const Sent& sent);
  void damage(Sent sent, Fault fault);
  // What a group becomes of which these frames are left, and that will not complete.
  void expect_given_up(std::size_t frames_left);
  std::size_t any(std::size_t count) { return random_() % count; }

  std::mt19937_64 random_;
  Unit unit_;
  Listener listener_;
  dottrack_counts expected_{};
  std::array<std::uint64_t, kFaults> injected_{};
  std::map<std::uint64_t, Group> fresh_not_yet_;  // by capture time
  std::uint64_t wrong_poses_ = 0;
};

}  // namespace dottrack::receiver_test
