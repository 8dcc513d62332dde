#pragma once
// How well the groups come: rates, ages, jitter. What was lost, the receiver counts itself.

#include <array>
#include <cstdint>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/base/time.h"

namespace dottrack::monitor {

// Events a second over the last one to two seconds.
class RateMeter {
 public:
  void count(Duration now);
  double per_second(Duration now) const;

 private:
  static constexpr Duration kBin = std::chrono::milliseconds(250);
  static constexpr std::size_t kBins = 8;

  void move_to(std::int64_t bin);

  std::array<std::uint32_t, kBins> bins_{};
  std::int64_t bin_ = 0;
  std::int64_t first_bin_ = -1;
};

class Statistics {
 public:
  void frame(Duration now);
  void group(const dottrack_pose& pose, bool fresh, Duration now);
  void silence() { ++silences_; }

  std::uint64_t groups() const { return groups_; }            // whole ones
  std::uint64_t fresh_poses() const { return fresh_poses_; }  // fresh and valid
  std::uint64_t silences() const { return silences_; }  // times that fresh groups ceased to come
  Duration span() const { return last_ - first_; }      // from the first frame to the last
  double groups_per_s() const;                          // over everything
  double frames_per_s() const;
  double groups_per_s(Duration now) const { return group_rate_.per_second(now); }
  double frames_per_s(Duration now) const { return frame_rate_.per_second(now); }

  // Of fresh groups.
  double mean_age_s() const;
  double max_age_s() const { return max_age_s_; }
  // How unevenly groups arrive, beside how unevenly they were captured: the change of the delay
  // from group to group.
  double rms_jitter_s() const;
  double max_jitter_s() const { return max_jitter_s_; }

 private:
  void add_delay(const dottrack_pose& pose);

  std::uint64_t frames_ = 0;
  std::uint64_t groups_ = 0;
  std::uint64_t fresh_groups_ = 0;
  std::uint64_t fresh_poses_ = 0;
  std::uint64_t silences_ = 0;
  Duration first_{};
  Duration last_{};
  RateMeter frame_rate_;
  RateMeter group_rate_;
  double sum_age_s_ = 0.0;
  double max_age_s_ = 0.0;
  std::uint64_t last_capture_us_ = 0;
  std::uint64_t last_arrival_us_ = 0;
  std::uint64_t delays_ = 0;
  double sum_squared_jitter_s2_ = 0.0;
  double max_jitter_s_ = 0.0;
};

// Groups that the unit sent and that did not come to any use for want of frames, of all it sent.
double share_lost(const dottrack_counts& counts);

// Nothing was lost, damaged, repeated or late.
bool is_spotless(const dottrack_counts& counts);

}  // namespace dottrack::monitor
