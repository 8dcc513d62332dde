#include "app/workstation/sim_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/telemetry/output_file.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/svg_chart.h"

namespace dottrack::workstation {
namespace {

using Eigen::Vector2d;

constexpr const char* kTrue = "#999999";
constexpr const char* kReported = "#1f6fd0";
constexpr const char* kSecond = "#d07b1f";
constexpr const char* kThird = "#2f9e44";
constexpr const char* kWrong = "#d02020";

const Vector2d kBreak = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

// One point a tick, a break where `value` has none.
template <class Value>
std::vector<Vector2d> over_time(std::span<const TruthRow> rows, Value value) {
  std::vector<Vector2d> points;
  for (const TruthRow& row : rows) points.emplace_back(row.time_s, value(row));
  return points;
}

std::vector<Vector2d> outline(const FloorPlan& plan) {
  const double x = 0.5 * plan.length_m;
  const double y = 0.5 * plan.width_m;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}, {-x, -y}};
}

Chart path_chart(std::span<const TruthRow> rows, const FloorPlan& plan) {
  Series truth{"truth", kTrue, Style::line, {}};
  Series reported{"reported", kReported, Style::points, {}};
  Series wrong{"wrong lock", kWrong, Style::points, {}};
  for (const TruthRow& row : rows) {
    truth.points.push_back(row.truth ? Vector2d(row.truth->position_m.head<2>()) : kBreak);
    if (row.has_pose) {
      (row.wrong_lock() ? wrong : reported).points.push_back(row.position_m.head<2>());
    }
  }
  if (wrong.points.empty()) wrong.label.clear();
  return {.title = "The path from above",
          .x_label = "x, m",
          .y_label = "y, m",
          .series = {{"", "#222222", Style::line, outline(plan)},
                     {"cameras", kSecond, Style::points, plan.cameras_m},
                     truth,
                     reported,
                     wrong},
          .equal_scales = true};
}

std::array<Chart, 2> error_charts(std::span<const TruthRow> rows) {
  const auto along = [&](int axis) {
    return over_time(rows, [axis](const TruthRow& row) {
      return row.error ? 1000.0 * row.error->position_m[axis] : kBreak.x();
    });
  };
  const auto about = [&](int axis) {
    return over_time(rows, [axis](const TruthRow& row) {
      return row.error ? 180.0 / M_PI * row.error->rotation_rad[axis] : kBreak.x();
    });
  };
  return {Chart{.title = "Position error",
                .x_label = "time, s",
                .y_label = "mm",
                .series = {{"x", kReported, Style::line, along(0)},
                           {"y", kSecond, Style::line, along(1)},
                           {"z", kThird, Style::line, along(2)}}},
          Chart{.title = "Attitude error",
                .x_label = "time, s",
                .y_label = "degrees, about the world's axes",
                .series = {{"x", kReported, Style::line, about(0)},
                           {"y", kSecond, Style::line, about(1)},
                           {"z", kThird, Style::line, about(2)}}}};
}

Chart usage_chart(std::span<const TruthRow> rows) {
  const auto count = [&](auto value) { return over_time(rows, value); };
  return {.title = "In use",
          .x_label = "time, s",
          .y_label = "number",
          .series = {{"cameras", kReported, Style::steps,
                      count([](const TruthRow& row) { return double(row.cameras_used); })},
                     {"dots", kSecond, Style::steps,
                      count([](const TruthRow& row) { return double(row.dots_used); })}},
          .y_from_zero = true};
}

constexpr int kBins = 40;

Chart times_chart(std::span<const TruthRow> rows) {
  std::vector<double> times_ms;
  for (const TruthRow& row : rows) times_ms.push_back(1000.0 * to_seconds(row.cycle));
  std::sort(times_ms.begin(), times_ms.end());
  const double longest_ms = times_ms.empty() ? 1.0 : times_ms.back();
  const double width_ms = round_step(longest_ms * 1.001, kBins);
  std::vector<Vector2d> bars;
  for (int bin = 0; bin * width_ms <= longest_ms + width_ms; ++bin) {
    const auto from = std::lower_bound(times_ms.begin(), times_ms.end(), bin * width_ms);
    const auto to = std::lower_bound(times_ms.begin(), times_ms.end(), (bin + 1) * width_ms);
    bars.emplace_back(bin * width_ms, static_cast<double>(to - from));
  }
  return {.title = "How long a tick takes, without rendering",
          .x_label = "ms",
          .y_label = "ticks",
          .series = {{"", kReported, Style::bars, bars}},
          .y_from_zero = true};
}

}  // namespace

Result<void> write_plots(std::span<const TruthRow> rows, const FloorPlan& plan,
                         const std::filesystem::path& folder) {
  if (auto made = make_folder(folder); !made) return made;
  const auto write = [&](const char* name, std::span<const Chart> charts) {
    return telemetry::write_file(folder / name, svg(charts));
  };
  if (auto done = write("path.svg", std::array{path_chart(rows, plan)}); !done) return done;
  if (auto done = write("errors.svg", error_charts(rows)); !done) return done;
  if (auto done = write("usage.svg", std::array{usage_chart(rows)}); !done) return done;
  return write("cycle_times.svg", std::array{times_chart(rows)});
}

}  // namespace dottrack::workstation
