#include "app/workstation/monitor/text_lines.h"

#include <fmt/format.h>

#include "app/workstation/monitor/pose_words.h"

namespace dottrack::monitor {
namespace {

std::string age_text(const dottrack_pose& pose) {
  const auto age = age_s(pose);
  return age ? fmt::format("{:.1f} ms", 1000.0 * *age) : "unknown";
}

std::string pose_text(const dottrack_pose& pose) {
  std::string text = fmt::format("  {:>3} {}", pose.sequence, dottrack_state_text(pose.state));
  if (pose.valid) {
    const RollPitchYaw angles = roll_pitch_yaw(pose.orientation_wxyz);
    text += fmt::format("  {:.4f} {:.4f} {:.4f} m  rpy {:.3f} {:.3f} {:.3f} deg",
                        pose.position_m[0], pose.position_m[1], pose.position_m[2], angles.roll_deg,
                        angles.pitch_deg, angles.yaw_deg);
    if (pose.kind != DOTTRACK_MEASURED) text += fmt::format("  {}", dottrack_kind_text(pose.kind));
  } else {
    text +=
        fmt::format("  {}", pose.out_of_range ? "out_of_range" : dottrack_reason_text(pose.reason));
  }
  text += fmt::format("  age {}  cameras {}  dots {}", age_text(pose),
                      camera_numbers(pose.cameras_used), pose.dots_used);
  if (pose.degraded != 0) text += "  " + degraded_words(pose.degraded);
  if (pose.restarted) text += "  (the unit restarted)";
  return text;
}

}  // namespace

std::string report_line(const Report& report) {
  std::string line =
      fmt::format("{} {:<10}", seconds_text(report.time), dottrack_verdict_text(report.verdict));
  if (report.pose != nullptr) line += pose_text(*report.pose);
  if (report.id) line += fmt::format("  frame {:03X}", *report.id);
  const bool silence = report.verdict == DOTTRACK_STALE && !report.pose && !report.id;
  if (silence) line += "  no fresh group within the age limit";
  if (report.groups_lost > 0) line += fmt::format("  ({} lost before)", report.groups_lost);
  return line;
}

std::string statistics_text(const Overview& overview) {
  const Statistics& s = overview.statistics;
  const dottrack_counts& c = overview.counts;
  std::string text =
      fmt::format("{} frames in {:.3f} s ({:.1f}/s), {} whole groups ({:.1f}/s)\n", c.frames,
                  to_seconds(s.span()), s.frames_per_s(), s.groups(), s.groups_per_s());
  text += fmt::format(
      "groups: fresh {} (with a pose {}), stale {}, repeated {}, incomplete {}, lost {}; "
      "{:.3f} % lost\n",
      c.fresh, s.fresh_poses(), c.stale, c.repeated_groups, c.incomplete, c.lost_groups,
      100.0 * share_lost(c));
  text += fmt::format("frames: corrupted {}, repeated {}, late {}, of another version {}\n",
                      c.corrupted, c.repeated_frames, c.late_frames, c.other_version);
  text += fmt::format(
      "age: mean {:.1f} ms, max {:.1f} ms; jitter: RMS {:.2f} ms, max {:.2f} ms; "
      "silences {}, restarts {}\n",
      1e3 * s.mean_age_s(), 1e3 * s.max_age_s(), 1e3 * s.rms_jitter_s(), 1e3 * s.max_jitter_s(),
      s.silences(), c.restarts);
  text += fmt::format("unit: {}\n", unit_words(overview.unit));
  const std::string light = light_words(overview.lights);
  if (!light.empty()) text += fmt::format("light: {}\n", light);
  if (overview.unreadable_lines > 0) {
    text += fmt::format("lines of the log that are no frames: {}\n", overview.unreadable_lines);
  }
  return text;
}

void TextLines::do_report(const Report& report, const Overview&) {
  fmt::print(out_, "{}\n", report_line(report));
  std::fflush(out_);
}

Result<void> TextLines::do_finish(const Overview& overview) {
  fmt::print(out_, "{}", statistics_text(overview));
  if (std::fflush(out_) != 0 || std::ferror(out_) != 0) {
    return fail("standard output cannot be written");
  }
  return {};
}

}  // namespace dottrack::monitor
