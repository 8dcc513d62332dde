#include "app/workstation/trial_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dottrack::workstation {
namespace {

constexpr std::string_view kHeader =
    "index,x_m,y_m,yaw_deg,dots,dots_in_two_views,lockable,outcome,reason,lock_tick,position_mm,"
    "attitude_deg,candidate_false_lock_probability,candidate_right\n";

std::string heading() {
  return fmt::format("  {:<42} {:>8} {:>8} {:>9} {:>8} {:>9} {:>8}\n", "random placements", "all",
                     "right", "right %", "wrong", "held back", "none");
}

std::string rows(const TrialSummary& s, const std::string& title) {
  const std::string share = s.placements == 0
                                ? ""
                                : fmt::format("{:.2f}", 100.0 * static_cast<double>(s.right) /
                                                            static_cast<double>(s.placements));
  std::string text = fmt::format("  {:<42} {:>8} {:>8} {:>9} {:>8} {:>9} {:>8}\n", title,
                                 s.placements, s.right, share, s.wrong, s.held_back, s.none);
  for (const auto& [ticks, count] : s.right_after_ticks) {
    text += fmt::format("      {:<38} {:>17}\n",
                        fmt::format("right after {} tick{}", ticks, ticks == 1 ? "" : "s"), count);
  }
  for (const auto& [reason, count] : s.reasons) {
    text += fmt::format("      no lock: {:<67} {:>17}\n", reason, count);
  }
  return text;
}

std::string verdict(const CalibrationBin& bin) {
  if (bin.candidates == 0) return "";
  if (bin.too_few_to_show()) return "fewer expected than would show";
  if (bin.wrong == 0) return "none of the expected: cautious";
  return fmt::format("observed / mean {:.2f}", bin.wrong_rate() / bin.mean_probability());
}

std::string row(const std::string& title, const CalibrationBin& bin) {
  const std::string rate = bin.candidates == 0 ? "" : fmt::format("{:.2g}", bin.wrong_rate());
  const std::string mean = bin.candidates == 0 ? "" : fmt::format("{:.2g}", bin.mean_probability());
  return fmt::format("  {:<20} {:>10} {:>12} {:>14.3g} {:>8} {:>14}   {}\n", title, bin.candidates,
                     mean, bin.expected_wrong, bin.wrong, rate, verdict(bin));
}

std::string title_of(const CalibrationBin& bin) {
  return bin.from > 0.0 ? fmt::format("{:.0e} to {:.0e}", bin.from, bin.to)
                        : fmt::format("{:.0e} or less", bin.to);
}

std::string calibration_text(std::span<const Trial> trials) {
  const auto bins = calibration_of(trials);
  CalibrationBin all;
  std::string text =
      fmt::format("  {:<20} {:>10} {:>12} {:>14} {:>8} {:>14}\n", "false-lock probability",
                  "candidates", "mean", "expected wrong", "wrong", "observed rate");
  for (const CalibrationBin& bin : bins) {
    if (bin.candidates > 0) text += row(title_of(bin), bin);
    all.candidates += bin.candidates;
    all.expected_wrong += bin.expected_wrong;
    all.wrong += bin.wrong;
  }
  return text + row("all", all);
}

std::size_t decade_of(double probability) {
  const double decades = probability > 0.0 ? std::floor(-std::log10(probability)) : 1e9;
  return static_cast<std::size_t>(
      std::clamp(decades, 0.0, static_cast<double>(kCalibrationDecades - 1)));
}

}  // namespace

TrialSummary summary_of(std::span<const Trial> trials, bool lockable) {
  TrialSummary summary;
  for (const Trial& trial : trials) {
    if (trial.lockable() != lockable) continue;
    ++summary.placements;
    switch (trial.outcome) {
      case Outcome::right_lock:
        ++summary.right;
        ++summary.right_after_ticks[trial.lock_tick + 1];
        break;
      case Outcome::wrong_lock:
        ++summary.wrong;
        break;
      case Outcome::held_back:
        ++summary.held_back;
        break;
      case Outcome::no_lock:
        ++summary.none;
        break;
    }
    if (!trial.locked()) ++summary.reasons[std::string(core::to_string(trial.reason))];
  }
  return summary;
}

std::array<CalibrationBin, kCalibrationDecades> calibration_of(std::span<const Trial> trials) {
  std::array<CalibrationBin, kCalibrationDecades> bins;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].to = std::pow(10.0, -static_cast<double>(i));
    bins[i].from = i + 1 < bins.size() ? std::pow(10.0, -static_cast<double>(i + 1)) : 0.0;
  }
  for (const Trial& trial : trials) {
    if (!trial.candidate) continue;
    CalibrationBin& bin = bins[decade_of(trial.candidate->false_lock_probability)];
    ++bin.candidates;
    bin.expected_wrong += trial.candidate->false_lock_probability;
    bin.wrong += trial.candidate->right ? 0U : 1U;
  }
  return bins;
}

std::string summary_text(std::span<const Trial> trials) {
  return heading() + rows(summary_of(trials, true), "enough dots in two views to lock on to") +
         rows(summary_of(trials, false), "too few") +
         "how often the first candidate was a wrong one, by the tracker's own estimate\n" +
         calibration_text(trials);
}

std::string trials_csv_header() {
  return std::string(kHeader);
}

std::string csv_line(const Trial& t) {
  const auto known = [](bool there, auto value) {
    return there ? fmt::format("{}", value) : std::string();
  };
  const auto rounded = [&](double value) { return t.locked() ? fmt::format("{:.4f}", value) : ""; };
  const Candidate candidate = t.candidate.value_or(Candidate{});
  return fmt::format("{},{:.4f},{:.4f},{:.2f},{},{},{},{},{},{},{},{},{},{}\n", t.index, t.x_m,
                     t.y_m, 180.0 / M_PI * t.yaw_rad, t.dots, t.dots_in_two_views,
                     t.lockable() ? 1 : 0, to_string(t.outcome), core::to_string(t.reason),
                     known(t.locked(), t.lock_tick), rounded(t.position_mm),
                     rounded(t.attitude_deg),
                     known(t.candidate.has_value(), candidate.false_lock_probability),
                     known(t.candidate.has_value(), candidate.right ? 1 : 0));
}

std::string calibration_csv(std::span<const Trial> trials) {
  std::string text =
      "from,to,candidates,mean_probability,expected_wrong,wrong,observed_rate,too_few_to_show\n";
  for (const CalibrationBin& bin : calibration_of(trials)) {
    text += fmt::format("{:g},{:g},{},{},{},{},{},{}\n", bin.from, bin.to, bin.candidates,
                        bin.mean_probability(), bin.expected_wrong, bin.wrong, bin.wrong_rate(),
                        bin.too_few_to_show() ? 1 : 0);
  }
  return text;
}

}  // namespace dottrack::workstation
