#include "app/workstation/monitor/json_lines.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <span>

#include "app/workstation/monitor/pose_words.h"

namespace dottrack::monitor {
namespace {

// Members in the order in which they are added. No text needs escaping: all are words of ours.
class Object {
 public:
  Object& add(std::string_view key, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "{}\"{}\":{}", text_.empty() ? "" : ",", key, value);
    return *this;
  }
  Object& add_word(std::string_view key, std::string_view word) {
    return add(key, fmt::format("\"{}\"", word));
  }
  Object& add_number(std::string_view key, double number) {
    return add(key, std::isfinite(number) ? fmt::format("{}", number) : "null");
  }
  Object& add_known(std::string_view key, bool known, double number) {
    return known ? add_number(key, number) : add(key, "null");
  }
  Object& add_count(std::string_view key, std::uint64_t count) {
    return add(key, fmt::format("{}", count));
  }
  Object& add_flag(std::string_view key, bool flag) { return add(key, flag ? "true" : "false"); }
  Object& add_numbers(std::string_view key, bool known, std::span<const double> numbers) {
    return add(key, known ? fmt::format("[{}]", fmt::join(numbers, ",")) : "null");
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string camera_list(std::uint16_t cameras) {
  std::string list;
  for (unsigned i = 0; i < DOTTRACK_MAX_CAMERAS; ++i) {
    if (((unsigned{cameras} >> i) & 1U) == 0) continue;
    list += fmt::format("{}{}", list.empty() ? "" : ",", i + 1);
  }
  return "[" + list + "]";
}

std::string degraded_list(std::uint16_t degraded) {
  std::string list;
  for (unsigned bit = 0; bit < 16; ++bit) {
    if (((unsigned{degraded} >> bit) & 1U) == 0) continue;
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ",", dottrack_degraded_text(bit));
  }
  return "[" + list + "]";
}

std::string health_list(const dottrack_pose& pose) {
  if (!pose.has_cameras) return "null";
  std::string list;
  for (const std::uint8_t health : pose.camera_health) {
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ",", dottrack_health_text(health));
  }
  return "[" + list + "]";
}

std::string dot_object(const dottrack_dot& dot) {
  constexpr std::string_view kWords[] = {"not_seen", "one_camera", "located"};
  Object object;
  object.add_word("visibility",
                  dot.visibility < std::size(kWords) ? kWords[dot.visibility] : "unknown");
  object.add("cameras", camera_list(dot.cameras));
  object.add_numbers("position_m", dot.has_position, dot.position_m);
  object.add_known("sigma_m", dot.sigma_m >= 0.0, dot.sigma_m);
  return object.text();
}

std::string dot_list(const dottrack_pose& pose) {
  if (pose.dots == 0) return "null";
  std::string list;
  for (unsigned i = 0; i < pose.dots; ++i) {
    list += i == 0 ? "" : ",";
    list += dot_object(pose.dot[i]);
  }
  return "[" + list + "]";
}

void add_status(Object& object, const dottrack_pose& pose) {
  object.add_count("sequence", pose.sequence)
      .add_word("state", dottrack_state_text(pose.state))
      .add_word("reason", dottrack_reason_text(pose.reason))
      .add_flag("valid", pose.valid)
      .add_word("kind", dottrack_kind_text(pose.kind))
      .add_flag("out_of_range", pose.out_of_range)
      .add("capture_s", seconds_text(std::chrono::microseconds(pose.capture_us)))
      .add_known("age_s", age_s(pose).has_value(), age_s(pose).value_or(0.0))
      .add("cameras_used", camera_list(pose.cameras_used))
      .add_count("dots_used", pose.dots_used)
      .add("degraded", degraded_list(pose.degraded))
      .add_count("reset_count", pose.reset_count)
      .add_flag("restarted", pose.restarted);
}

void add_pose(Object& object, const dottrack_pose& pose) {
  const RollPitchYaw angles = roll_pitch_yaw(pose.orientation_wxyz);
  const double degrees[] = {angles.roll_deg, angles.pitch_deg, angles.yaw_deg};
  const auto deviations = sigmas(pose).value_or(std::array<double, 6>{});
  const std::span<const double> six(deviations);
  object.add_numbers("position_m", pose.valid, pose.position_m)
      .add_numbers("quaternion_wxyz", pose.valid, pose.orientation_wxyz)
      .add_numbers("rpy_deg", pose.valid, degrees)
      .add_known("residual_m", pose.residual_m >= 0.0, pose.residual_m)
      .add_known("false_lock_probability", pose.false_lock_probability >= 0.0,
                 pose.false_lock_probability)
      .add_numbers("sigma_m", pose.has_covariance, six.first(3))
      .add_numbers("sigma_rad", pose.has_covariance, six.last(3))
      .add_numbers("covariance", pose.has_covariance, pose.covariance)
      .add_numbers("velocity_m_s", pose.has_velocity, pose.velocity_m_s)
      .add_numbers("rates_rad_s", pose.has_rates, pose.rates_rad_s)
      .add("cameras", health_list(pose))
      .add("dots", dot_list(pose));
}

std::string unit_object(const dottrack_unit& unit) {
  Object object;
  object.add("version", unit.has_version
                            ? fmt::format("\"{}.{}.{}\"", unit.major, unit.minor, unit.patch)
                            : "null");
  object.add_known("protocol", unit.has_version, unit.protocol)
      .add_known("group_period_s", unit.has_version, 1e-6 * unit.group_period_us)
      .add("configuration",
           unit.has_configuration ? fmt::format("\"{:08X}\"", unit.config_hash) : "null")
      .add_known("target", unit.has_configuration, unit.target)
      .add_known("cameras", unit.has_configuration, unit.cameras);
  return object.text();
}

std::string light_object(std::size_t camera, const dottrack_light& light) {
  Object object;
  object.add_count("camera", camera + 1)
      .add_word("state", dottrack_light_text(light.state))
      .add_word("iris", dottrack_iris_text(light.iris))
      .add_known("exposure_s", light.exposure_s >= 0.0, light.exposure_s)
      .add_known("gain", light.gain >= 0.0, light.gain)
      .add_known("opening", light.opening >= 0.0, light.opening);
  return object.text();
}

// Of the cameras that anything was told of.
std::string light_list(std::span<const dottrack_light> lights) {
  std::string list;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].known) list += (list.empty() ? "" : ",") + light_object(i, lights[i]);
  }
  return list.empty() ? "null" : "[" + list + "]";
}

void add_counts(Object& object, const dottrack_counts& counts) {
  object.add_count("frames", counts.frames)
      .add_count("fresh", counts.fresh)
      .add_count("stale", counts.stale)
      .add_count("repeated_groups", counts.repeated_groups)
      .add_count("incomplete", counts.incomplete)
      .add_count("lost_groups", counts.lost_groups)
      .add_count("corrupted", counts.corrupted)
      .add_count("repeated_frames", counts.repeated_frames)
      .add_count("late_frames", counts.late_frames)
      .add_count("other_version", counts.other_version)
      .add_count("restarts", counts.restarts);
}

bool print_line(std::FILE* out, const std::string& line) {
  return std::fwrite(line.data(), 1, line.size(), out) == line.size() &&
         std::fputc('\n', out) != EOF;
}

}  // namespace

std::string report_object(const Report& report) {
  Object object;
  object.add_word("verdict", dottrack_verdict_text(report.verdict));
  object.add("arrival_s", seconds_text(report.time));
  object.add_count("groups_lost_before", report.groups_lost);
  if (report.id) object.add_count("id", *report.id);
  if (report.pose != nullptr) {
    add_status(object, *report.pose);
    add_pose(object, *report.pose);
  }
  return object.text();
}

std::string summary_object(const Overview& overview) {
  const Statistics& statistics = overview.statistics;
  Object object;
  object.add_flag("summary", true);
  object.add_number("seconds", to_seconds(statistics.span()));
  object.add_count("fresh_valid_poses", statistics.fresh_poses());
  add_counts(object, overview.counts);
  object.add_count("silences", statistics.silences())
      .add_count("unreadable_lines", overview.unreadable_lines)
      .add_number("share_lost", share_lost(overview.counts))
      .add_number("groups_per_s", statistics.groups_per_s())
      .add_number("frames_per_s", statistics.frames_per_s())
      .add_number("mean_age_s", statistics.mean_age_s())
      .add_number("max_age_s", statistics.max_age_s())
      .add_number("rms_jitter_s", statistics.rms_jitter_s())
      .add_number("max_jitter_s", statistics.max_jitter_s())
      .add("unit", unit_object(overview.unit))
      .add("light", light_list(overview.lights));
  return object.text();
}

// Line by line: whoever reads may be waiting.
void JsonLines::do_report(const Report& report, const Overview&) {
  print_line(out_, report_object(report));
  std::fflush(out_);
}

Result<void> JsonLines::do_finish(const Overview& overview) {
  const bool written = print_line(out_, summary_object(overview)) && std::fflush(out_) == 0 &&
                       std::ferror(out_) == 0;
  if (!written) return fail("standard output cannot be written");
  return {};
}

}  // namespace dottrack::monitor
