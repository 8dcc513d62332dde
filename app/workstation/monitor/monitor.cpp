#include "app/workstation/monitor/monitor.h"
#include "app/core/protocol/receiver_frame.h"

#include <utility>

namespace dottrack::monitor {
namespace {

std::uint64_t microseconds(Duration time) {
  return static_cast<std::uint64_t>(std::chrono::floor<std::chrono::microseconds>(time).count());
}

}  // namespace

Monitor::Monitor(const dottrack_settings& settings, std::vector<std::unique_ptr<Writer>> writers)
    : writers_(std::move(writers)) {
  dottrack_receiver_init(&receiver_, &settings);
}

Overview Monitor::overview() const {
  return {statistics_, receiver_.counts, receiver_.unit, unreadable_lines_, receiver_.light};
}

void Monitor::run(FrameSource& source, const MonitorLimits& limits,
                  const std::function<bool()>& wanted) {
  std::optional<Duration> start;
  Arrival arrival;
  while (wanted()) {
    const FrameSource::Got got = source.next(arrival);
    if (got == FrameSource::Got::end) return;
    if (!start) start = arrival.time;
    if (limits.duration && arrival.time - *start > *limits.duration) return;
    look_at_time(arrival.time);
    if (got == FrameSource::Got::frame) take(arrival);
    const std::string notice = got == FrameSource::Got::nothing ? source.notice() : std::string();
    for (const auto& writer : writers_) {
      if (!notice.empty()) writer->notice(notice);
      if (got == FrameSource::Got::nothing) writer->pause(arrival.time, overview());
    }
    if (limits.poses && statistics_.fresh_poses() >= *limits.poses) return;
  }
}

// What the passing of time alone brings about.
void Monitor::look_at_time(Duration now) {
  const dottrack_verdict verdict = dottrack_receiver_poll(&receiver_, microseconds(now));
  if (verdict == DOTTRACK_INCOMPLETE) {
    Report report;
    report.verdict = verdict;
    report.time = now;
    send(report);
  }
  if (verdict != DOTTRACK_STALE || !fresh_) return;
  fresh_ = false;
  statistics_.silence();
  Report report;
  report.verdict = DOTTRACK_STALE;
  report.time = now;
  send(report);
}

void Monitor::take(const Arrival& arrival) {
  const dottrack_frame frame = protocol::to_receiver(arrival.frame);
  const dottrack_counts before = receiver_.counts;
  dottrack_pose pose{};
  const dottrack_verdict verdict =
      dottrack_receiver_push(&receiver_, &frame, microseconds(arrival.time), &pose);
  if (verdict == DOTTRACK_FOREIGN) return;
  statistics_.frame(arrival.time);
  for (const auto& writer : writers_) writer->frame(arrival);
  tell(verdict, arrival, before, pose);
}

void Monitor::tell(dottrack_verdict verdict, const Arrival& arrival, const dottrack_counts& before,
                   const dottrack_pose& pose) {
  const dottrack_counts& after = receiver_.counts;
  Report report;
  report.time = arrival.time;
  for (std::uint64_t i = before.incomplete; i < after.incomplete; ++i) {
    report.verdict = DOTTRACK_INCOMPLETE;
    send(report);
  }
  if (verdict == DOTTRACK_WAITING || verdict == DOTTRACK_INCOMPLETE) return;
  report.verdict = verdict;
  const bool whole = after.fresh != before.fresh || after.stale != before.stale;
  if (whole) {
    report.pose = &pose;
    fresh_ = fresh_ || verdict == DOTTRACK_FRESH;
    statistics_.group(pose, verdict == DOTTRACK_FRESH, arrival.time);
  } else if (after.repeated_groups == before.repeated_groups) {
    report.id = arrival.frame.id;
  }
  send(report);
}

void Monitor::send(Report report) {
  report.groups_lost = receiver_.counts.lost_groups - told_lost_;
  told_lost_ = receiver_.counts.lost_groups;
  for (const auto& writer : writers_) writer->report(report, overview());
}

Result<void> Monitor::finish(std::uint64_t unreadable_lines) {
  unreadable_lines_ = unreadable_lines;
  Result<void> first;
  for (const auto& writer : writers_) {
    const Result<void> finished = writer->finish(overview());
    if (first && !finished) first = finished;
  }
  return first;
}

}  // namespace dottrack::monitor
