#include "app/workstation/run_tally.h"

#include <algorithm>
#include <cmath>

namespace dottrack::workstation {
namespace {

double microseconds(Duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

// The smallest value that at least this fraction of all values does not exceed.
Duration nearest_rank(const std::vector<Duration>& sorted, double fraction) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

TimeFigures figures_of(std::vector<Duration> durations) {
  if (durations.empty()) return {};
  std::sort(durations.begin(), durations.end());
  return {microseconds(nearest_rank(durations, 0.50)), microseconds(nearest_rank(durations, 0.99)),
          microseconds(durations.back())};
}

void RunTally::do_write(const telemetry::CycleRecord& record) {
  const core::TickResult& result = record.result;
  ++ticks_;
  ++reasons_[std::string(core::to_string(result.reason))];
  if (result.has_pose) {
    ++tracking_ticks_;
    residual_sum_m_ += result.pose.rms_residual_m;
    if (first_lock_tick_ < 0) first_lock_tick_ = static_cast<std::int64_t>(result.tick);
    last_lock_ = result;
  }
  const telemetry::StageTimes& took = record.stages;
  const std::array<Duration, kTimes> times = {took.cycle(),   took.capture, took.track,
                                              took.broadcast, took.expose,  took.record};
  for (std::size_t i = 0; i < kTimes; ++i) durations_[i].push_back(times[i]);
  last_record_ = record;
}

std::uint64_t RunTally::reacquisitions() const {
  const std::uint32_t locks = last_record_.result.reset_count;
  return locks == 0 ? 0 : locks - 1;
}

double RunTally::mean_rms_residual_m() const {
  return tracking_ticks_ == 0 ? 0.0 : residual_sum_m_ / static_cast<double>(tracking_ticks_);
}

std::vector<std::pair<std::string, TimeFigures>> RunTally::times() const {
  constexpr std::array<const char*, kTimes> kNames = {"cycle",     "capture", "track",
                                                      "broadcast", "expose",  "record"};
  std::vector<std::pair<std::string, TimeFigures>> all;
  for (std::size_t i = 0; i < kTimes; ++i) all.emplace_back(kNames[i], figures_of(durations_[i]));
  return all;
}

}  // namespace dottrack::workstation
