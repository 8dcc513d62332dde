#pragma once
// What the monitor has to tell, and who writes it down.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "app/workstation/monitor/frame_source.h"
#include "app/workstation/monitor/statistics.h"
#include "hal/base/result.h"

namespace dottrack::monitor {

// A group, or something that is wrong with one.
struct Report {
  dottrack_verdict verdict = DOTTRACK_FRESH;
  Duration time{};
  const dottrack_pose* pose = nullptr;  // of a whole group; else null
  std::optional<std::uint32_t> id;      // of a frame that has the verdict by itself
  std::uint64_t groups_lost = 0;        // since the report before, by the sequence
};

inline bool is_fresh_pose(const Report& report) {
  return report.verdict == DOTTRACK_FRESH && report.pose != nullptr && report.pose->valid;
}

// The state of things, at a report, at a pause or at the end.
struct Overview {
  const Statistics& statistics;
  const dottrack_counts& counts;
  const dottrack_unit& unit;
  std::uint64_t unreadable_lines = 0;
  std::span<const dottrack_light> lights = {};  // camera by camera
};

// Gets everything in the order in which it happened.
class Writer {
 public:
  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  virtual ~Writer() = default;

  void frame(const Arrival& arrival) { do_frame(arrival); }
  void report(const Report& report, const Overview& overview) { do_report(report, overview); }
  void pause(Duration now, const Overview& overview) { do_pause(now, overview); }
  void notice(const std::string& line) { do_notice(line); }
  // Once, after everything else. An error is one line.
  Result<void> finish(const Overview& overview) { return do_finish(overview); }

 private:
  virtual void do_frame(const Arrival&) {}
  virtual void do_report(const Report&, const Overview&) {}
  virtual void do_pause(Duration, const Overview&) {}
  virtual void do_notice(const std::string&) {}
  virtual Result<void> do_finish(const Overview&) { return {}; }
};

}  // namespace dottrack::monitor
