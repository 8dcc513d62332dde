#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/workstation/experiments.h"

namespace dottrack::workstation {
namespace {

bool within(const TruthRow& row, const host_sim::Span& span) {
  return row.time_s >= span.from_s && row.time_s < span.to_s;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double tilt_deg(const TruePose& truth) {
  const double up = (truth.orientation * Eigen::Vector3d::UnitZ()).z();
  return 180.0 / std::numbers::pi * std::acos(std::clamp(up, -1.0, 1.0));
}

}  // namespace

SurveyFigures survey_figures(std::span<const TruthRow> rows,
                             std::span<const host_sim::Span> places) {
  const Accuracy accuracy = accuracy_of(rows);
  SurveyFigures figures;
  figures.places = places.size();
  figures.rms_mm = accuracy.position_rms_mm;
  figures.max_mm = accuracy.position_max_mm;
  figures.attitude_rms_deg = accuracy.attitude_rms_deg;
  for (const host_sim::Span& place : places) {
    const bool found = std::any_of(rows.begin(), rows.end(), [&](const TruthRow& row) {
      return within(row, place) && row.has_pose;
    });
    figures.places_found += found ? 1 : 0;
  }
  return figures;
}

LineFigures line_figures(std::span<const TruthRow> rows, std::span<const host_sim::Span> lines) {
  LineFigures figures;
  for (const host_sim::Span& line : lines) {
    std::vector<Eigen::Vector3d> positions;
    for (const TruthRow& row : rows) {
      if (row.has_pose && within(row, line)) positions.push_back(row.position_m);
    }
    if (positions.size() < 3) continue;
    figures.lines.push_back(straightness_of(positions));
    figures.worst_line_mm = std::max(figures.worst_line_mm, 1000.0 * figures.lines.back().rms_m);
  }
  figures.all = together(figures.lines);
  figures.error_rms_mm = accuracy_of(rows).position_rms_mm;
  return figures;
}

DriveFigures drive_figures(std::span<const TruthRow> rows) {
  DriveFigures figures;
  std::vector<double> cycle_s;
  for (const TruthRow& row : rows) {
    ++figures.ticks;
    if (!row.has_pose) continue;
    ++figures.tracked;
    cycle_s.push_back(to_seconds(row.cycle));
    if (row.truth) figures.steepest_deg = std::max(figures.steepest_deg, tilt_deg(*row.truth));
  }
  const Accuracy accuracy = accuracy_of(rows);
  figures.wrong = accuracy.wrong_lock_ticks;
  figures.rms_mm = accuracy.position_rms_mm;
  const double median_s = median_of(std::move(cycle_s));
  figures.rate_hz = median_s > 0.0 ? 1.0 / median_s : 0.0;
  return figures;
}

AcquisitionFigures acquisition_figures(int dots, std::span<const Trial> trials) {
  AcquisitionFigures figures;
  figures.dots = dots;
  std::vector<double> times_ms;
  for (const Trial& trial : trials) {
    figures.wrong += trial.outcome == Outcome::wrong_lock ? 1U : 0U;
    if (!trial.lockable()) continue;
    ++figures.lockable;
    if (trial.outcome != Outcome::right_lock) continue;
    ++figures.right;
    times_ms.push_back(1000.0 * to_seconds(trial.acquisition));
    figures.max_ms = std::max(figures.max_ms, times_ms.back());
  }
  figures.median_ms = median_of(std::move(times_ms));
  return figures;
}

}  // namespace dottrack::workstation
