#include "app/workstation/monitor/statistics.h"

#include <algorithm>
#include <cmath>

namespace dottrack::monitor {

void RateMeter::move_to(std::int64_t bin) {
  const std::int64_t steps = std::clamp<std::int64_t>(bin - bin_, 0, kBins);
  for (std::int64_t i = 1; i <= steps; ++i) {
    bins_[static_cast<std::size_t>(bin - steps + i) % kBins] = 0;
  }
  bin_ = std::max(bin, bin_);
}

void RateMeter::count(Duration now) {
  const std::int64_t bin = now / kBin;
  if (first_bin_ < 0) bin_ = first_bin_ = bin;
  move_to(bin);
  ++bins_[static_cast<std::size_t>(bin_) % kBins];
}

double RateMeter::per_second(Duration now) const {
  if (first_bin_ < 0) return 0.0;
  RateMeter moved = *this;
  moved.move_to(now / kBin);
  // The bin at hand is not over yet: it does not count.
  std::uint32_t events = 0;
  for (std::size_t i = 1; i < kBins; ++i) {
    events += moved.bins_[(static_cast<std::size_t>(moved.bin_) + i) % kBins];
  }
  const auto whole = std::min<std::int64_t>(moved.bin_ - first_bin_, kBins - 1);
  return whole <= 0 ? 0.0 : events / (to_seconds(kBin) * static_cast<double>(whole));
}

void Statistics::frame(Duration now) {
  if (frames_ == 0) first_ = now;
  last_ = now;
  ++frames_;
  frame_rate_.count(now);
}

void Statistics::group(const dottrack_pose& pose, bool fresh, Duration now) {
  ++groups_;
  group_rate_.count(now);
  if (!fresh) return;
  ++fresh_groups_;
  if (pose.valid) ++fresh_poses_;
  const double age_s = 1e-6 * pose.age_us;
  sum_age_s_ += age_s;
  max_age_s_ = std::max(max_age_s_, age_s);
  add_delay(pose);
}

void Statistics::add_delay(const dottrack_pose& pose) {
  if (fresh_groups_ > 1 && !pose.restarted) {
    // Differences are modulo 2^64, so their difference is right whatever the order.
    const auto change_us = static_cast<std::int64_t>((pose.arrival_us - last_arrival_us_) -
                                                     (pose.capture_us - last_capture_us_));
    const double change_s = 1e-6 * static_cast<double>(change_us);
    ++delays_;
    sum_squared_jitter_s2_ += change_s * change_s;
    max_jitter_s_ = std::max(max_jitter_s_, std::abs(change_s));
  }
  last_capture_us_ = pose.capture_us;
  last_arrival_us_ = pose.arrival_us;
}

double Statistics::groups_per_s() const {
  return span() > Duration::zero() ? static_cast<double>(groups_) / to_seconds(span()) : 0.0;
}

double Statistics::frames_per_s() const {
  return span() > Duration::zero() ? static_cast<double>(frames_) / to_seconds(span()) : 0.0;
}

double Statistics::mean_age_s() const {
  return fresh_groups_ == 0 ? 0.0 : sum_age_s_ / static_cast<double>(fresh_groups_);
}

double Statistics::rms_jitter_s() const {
  return delays_ == 0 ? 0.0 : std::sqrt(sum_squared_jitter_s2_ / static_cast<double>(delays_));
}

double share_lost(const dottrack_counts& counts) {
  const std::uint64_t lost = counts.incomplete + counts.lost_groups;
  const std::uint64_t sent = lost + counts.fresh + counts.stale;
  return sent == 0 ? 0.0 : static_cast<double>(lost) / static_cast<double>(sent);
}

bool is_spotless(const dottrack_counts& counts) {
  return counts.stale + counts.repeated_groups + counts.incomplete + counts.lost_groups +
             counts.corrupted + counts.repeated_frames + counts.late_frames +
             counts.other_version ==
         0;
}

}  // namespace dottrack::monitor
