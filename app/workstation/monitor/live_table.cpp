#include "app/workstation/monitor/live_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "app/workstation/monitor/pose_words.h"
#include "app/workstation/monitor/text_lines.h"

namespace dottrack::monitor {
namespace {

constexpr Duration kDrawEvery = std::chrono::milliseconds(100);
constexpr std::size_t kWidth = 79;
constexpr double kDegrees = 57.29577951308232;

std::string row(std::string_view name, std::string_view text) {
  return fmt::format("{:<11}{}", name, text);
}

std::string three(const double* numbers, double scale, int decimals) {
  return fmt::format("{:>11.{}f}{:>11.{}f}{:>11.{}f}", scale * numbers[0], decimals,
                     scale * numbers[1], decimals, scale * numbers[2], decimals);
}

std::string measured(bool known, const double* numbers, double scale, int decimals,
                     std::string_view unit) {
  return known ? three(numbers, scale, decimals) + " " + std::string(unit)
               : fmt::format("{:>11}{:>11}{:>11}", "-", "-", "-");
}

void add_pose_rows(std::vector<std::string>& lines, const dottrack_pose& pose) {
  const RollPitchYaw angles = roll_pitch_yaw(pose.orientation_wxyz);
  const double degrees[] = {angles.roll_deg, angles.pitch_deg, angles.yaw_deg};
  const auto deviations = sigmas(pose).value_or(std::array<double, 6>{});
  const bool known = pose.has_covariance;
  lines.push_back(row("", fmt::format("{:>11}{:>11}{:>11}", "x", "y", "z")));
  lines.push_back(row("position", measured(pose.valid, pose.position_m, 1.0, 4, "m")));
  lines.push_back(row("  sigma", measured(known, deviations.data(), 1e3, 2, "mm")));
  lines.push_back(row("velocity", measured(pose.has_velocity, pose.velocity_m_s, 1.0, 3, "m/s")));
  lines.push_back(row("", fmt::format("{:>11}{:>11}{:>11}", "roll", "pitch", "yaw")));
  lines.push_back(row("attitude", measured(pose.valid, degrees, 1.0, 3, "deg")));
  lines.push_back(row("  sigma", measured(known, &deviations[3], kDegrees, 3, "deg")));
  lines.push_back(row("rates", measured(pose.has_rates, pose.rates_rad_s, kDegrees, 2, "deg/s")));
}

std::string quality(const dottrack_pose& pose) {
  const auto age = age_s(pose);
  std::string text = age ? fmt::format("age {:.1f} ms", 1e3 * *age) : "age not known";
  if (pose.residual_m >= 0.0) text += fmt::format(", residual {:.2f} mm", 1e3 * pose.residual_m);
  if (pose.false_lock_probability >= 0.0) {
    text += fmt::format(", false lock <= {:.1e}", pose.false_lock_probability);
  }
  return text;
}

// Two rows: the states, and the irises.
void add_light_rows(std::vector<std::string>& lines, std::span<const dottrack_light> lights) {
  const std::string words = light_words(lights);
  if (words.empty()) return;
  const std::size_t end = words.find(';');
  lines.push_back(row("  light", words.substr(0, end)));
  lines.push_back(row("", words.substr(end + 2)));
}

void add_group_rows(std::vector<std::string>& lines, const TableContent& content,
                    std::span<const dottrack_light> lights) {
  const dottrack_pose& pose = content.pose;
  lines.push_back(row("state", fmt::format("{}, {}", dottrack_state_text(pose.state),
                                           dottrack_reason_text(pose.reason))));
  add_pose_rows(lines, pose);
  if (pose.valid) lines.push_back(row("  kind", dottrack_kind_text(pose.kind)));
  lines.push_back(row("quality", quality(pose)));
  lines.push_back(row("degraded", degraded_words(pose.degraded)));
  lines.push_back(row("cameras", fmt::format("used {}", camera_numbers(pose.cameras_used))));
  lines.push_back(row(
      "  health", content.cameras.has_cameras ? health_words(content.cameras) : "not told yet"));
  add_light_rows(lines, lights);
  lines.push_back(
      row("dots", fmt::format("{} used; reset count {}", pose.dots_used, pose.reset_count)));
}

void add_count_rows(std::vector<std::string>& lines, const Overview& overview, Duration now) {
  const Statistics& s = overview.statistics;
  const dottrack_counts& c = overview.counts;
  lines.push_back(row("unit", unit_words(overview.unit)));
  lines.push_back(row("traffic", fmt::format("{:.1f} groups/s, {:.0f} frames/s; jitter RMS {:.2f} "
                                             "ms, max {:.2f} ms",
                                             s.groups_per_s(now), s.frames_per_s(now),
                                             1e3 * s.rms_jitter_s(), 1e3 * s.max_jitter_s())));
  lines.push_back(row("groups", fmt::format("fresh {}, stale {}, repeated {}, incomplete {}, lost "
                                            "{} ({:.2f} %)",
                                            c.fresh, c.stale, c.repeated_groups, c.incomplete,
                                            c.lost_groups, 100.0 * share_lost(c))));
  lines.push_back(
      row("frames", fmt::format("corrupted {}, repeated {}, late {}, other version {}", c.corrupted,
                                c.repeated_frames, c.late_frames, c.other_version)));
}

}  // namespace

std::vector<std::string> table_lines(const TableContent& content, const Overview& overview,
                                     Duration now) {
  std::vector<std::string> lines{content.title};
  lines.push_back(row("verdict", content.verdict));
  if (content.has_pose) add_group_rows(lines, content, overview.lights);
  add_count_rows(lines, overview, now);
  lines.push_back(content.notice);
  for (std::string& line : lines) line.resize(std::min(line.size(), kWidth));
  return lines;
}

LiveTable::LiveTable(std::FILE* out, std::string title) : out_(out) {
  content_.title = std::move(title);
  content_.verdict = "nothing received yet";
}

void LiveTable::do_report(const Report& report, const Overview& overview) {
  const bool silence = report.verdict == DOTTRACK_STALE && !report.pose && !report.id;
  content_.verdict = silence ? "stale: no fresh group within the age limit"
                             : verdict_words(report.verdict, report.pose);
  if (silence) content_.has_pose = false;  // an old pose is no pose
  if (report.pose != nullptr) {
    content_.has_pose = true;
    content_.pose = *report.pose;
    if (report.pose->has_cameras) content_.cameras = *report.pose;
  }
  do_pause(report.time, overview);
}

void LiveTable::do_pause(Duration now, const Overview& overview) {
  now_ = now;
  if (drawn_lines_ == 0 || now - drawn_at_ >= kDrawEvery) draw(now, overview);
}

void LiveTable::do_notice(const std::string& line) {
  content_.notice = line;
}

void LiveTable::draw(Duration now, const Overview& overview) {
  const std::vector<std::string> lines = table_lines(content_, overview, now);
  std::string text = drawn_lines_ > 0 ? fmt::format("\x1b[{}A", drawn_lines_) : "";
  for (const std::string& line : lines) text += line + "\x1b[K\n";
  text += "\x1b[J";
  std::fwrite(text.data(), 1, text.size(), out_);
  std::fflush(out_);
  drawn_lines_ = lines.size();
  drawn_at_ = now;
}

Result<void> LiveTable::do_finish(const Overview& overview) {
  draw(now_, overview);
  fmt::print(out_, "{}", statistics_text(overview));
  std::fflush(out_);
  return {};
}

}  // namespace dottrack::monitor
