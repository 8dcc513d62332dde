#include "app/workstation/monitor/trajectory_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <iterator>
#include <limits>
#include <span>

#include "app/telemetry/pose_files.h"
#include "app/workstation/monitor/pose_words.h"

namespace dottrack::monitor {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void append(std::string& line, std::span<const double> numbers, bool known) {
  for (const double number : numbers) {
    fmt::format_to(std::back_inserter(line), ",{:.9g}", known ? number : kUnknown);
  }
}

unsigned count_of(std::uint16_t bits) {
  return static_cast<unsigned>(std::popcount(bits));
}

}  // namespace

void TumFile::do_report(const Report& report, const Overview&) {
  if (!is_fresh_pose(report)) return;
  const dottrack_pose& pose = *report.pose;
  const double* q = pose.orientation_wxyz;
  file_.write(telemetry::tum_line(Time(std::chrono::microseconds(pose.capture_us)),
                                  {pose.position_m[0], pose.position_m[1], pose.position_m[2]},
                                  {q[0], q[1], q[2], q[3]}));
}

std::string_view csv_header() {
  return "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z [],"
         "v_x [m/s],v_y [m/s],v_z [m/s],w_x [rad/s],w_y [rad/s],w_z [rad/s],"
         "sigma_x [m],sigma_y [m],sigma_z [m],"
         "sigma_roll [rad],sigma_pitch [rad],sigma_yaw [rad],"
         "residual [m],false_lock_probability [],age [s],arrival [s],"
         "cameras_used [],dots_used [],reset_count [],degraded [bits],sequence []\n";
}

std::string csv_line(const dottrack_pose& pose) {
  std::string line = fmt::format("{}", pose.capture_us * 1000U);
  const auto deviations = sigmas(pose).value_or(std::array<double, 6>{});
  append(line, pose.position_m, true);
  append(line, pose.orientation_wxyz, true);
  append(line, pose.velocity_m_s, pose.has_velocity);
  append(line, pose.rates_rad_s, pose.has_rates);
  append(line, deviations, pose.has_covariance);
  append(line, {&pose.residual_m, 1}, pose.residual_m >= 0.0);
  append(line, {&pose.false_lock_probability, 1}, pose.false_lock_probability >= 0.0);
  const std::array age{age_s(pose).value_or(kUnknown)};
  append(line, age, true);
  line += ',';
  line += seconds_text(std::chrono::microseconds(pose.arrival_us));
  line += fmt::format(",{},{},{},{},{}\n", count_of(pose.cameras_used), pose.dots_used,
                      pose.reset_count, pose.degraded, pose.sequence);
  return line;
}

CsvFile::CsvFile(telemetry::OutputFile file) : file_(std::move(file)) {
  file_.write(csv_header());
}

void CsvFile::do_report(const Report& report, const Overview&) {
  if (is_fresh_pose(report)) file_.write(csv_line(*report.pose));
}

}  // namespace dottrack::monitor
