#pragma once
// Frames through the receiver for vehicles, and what comes out of it to the writers.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

struct MonitorLimits {
  std::optional<Duration> duration;    // from the first moment of the source
  std::optional<std::uint64_t> poses;  // fresh valid ones
};

class Monitor {
 public:
  Monitor(const dottrack_settings& settings, std::vector<std::unique_ptr<Writer>> writers);

  // Until the source ends, a limit is reached or `wanted` says no.
  void run(FrameSource& source, const MonitorLimits& limits, const std::function<bool()>& wanted);
  // The first error that a writer had.
  Result<void> finish(std::uint64_t unreadable_lines);

  const Statistics& statistics() const { return statistics_; }
  const dottrack_counts& counts() const { return receiver_.counts; }
  const dottrack_unit& unit() const { return receiver_.unit; }

 private:
  void take(const Arrival& arrival);
  void look_at_time(Duration now);
  void tell(dottrack_verdict verdict, const Arrival& arrival, const dottrack_counts& before,
            const dottrack_pose& pose);
  void send(Report report);
  Overview overview() const;

  dottrack_receiver receiver_{};
  std::vector<std::unique_ptr<Writer>> writers_;
  Statistics statistics_;
  std::uint64_t unreadable_lines_ = 0;
  std::uint64_t told_lost_ = 0;
  bool fresh_ = false;  // groups come
};

}  // namespace dottrack::monitor
