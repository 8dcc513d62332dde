#pragma once
// What a run comes to: counts, times and the last pose.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/telemetry/recorder.h"

namespace dottrack::workstation {

// Durations of one stage, microseconds.
struct TimeFigures {
  double p50_us = 0.0;
  double p99_us = 0.0;
  double max_us = 0.0;
};

class RunTally final : public telemetry::RecordWriter {
 public:
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t tracking_ticks() const { return tracking_ticks_; }   // with a pose
  std::int64_t first_lock_tick() const { return first_lock_tick_; }  // -1: never
  std::uint64_t reacquisitions() const;
  double mean_rms_residual_m() const;  // over the ticks with a pose; 0 without any
  const std::optional<core::TickResult>& last_lock() const { return last_lock_; }
  const telemetry::CycleRecord& last_record() const { return last_record_; }
  const std::map<std::string, std::uint64_t>& reasons() const { return reasons_; }

  // "cycle" and every stage of the loop, in the order of the loop.
  std::vector<std::pair<std::string, TimeFigures>> times() const;

 private:
  static constexpr std::size_t kTimes = 6;

  void do_write(const telemetry::CycleRecord& record) override;

  std::uint64_t ticks_ = 0;
  std::uint64_t tracking_ticks_ = 0;
  std::int64_t first_lock_tick_ = -1;
  double residual_sum_m_ = 0.0;
  std::optional<core::TickResult> last_lock_;
  telemetry::CycleRecord last_record_;
  std::map<std::string, std::uint64_t> reasons_;  // ticks that ended with each
  std::array<std::vector<Duration>, kTimes> durations_;
};

// Nearest-rank percentiles; all 0 when there are no durations.
TimeFigures figures_of(std::vector<Duration> durations);

}  // namespace dottrack::workstation
