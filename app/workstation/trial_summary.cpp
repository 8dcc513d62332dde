#include "app/workstation/trial_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dottrack::workstation {
namespace {

constexpr std::string_view kHeader =
    "scene,seed,index,x_m,y_m,yaw_deg,dots,dots_in_two_views,dots_well_lit,lockable,ticks_allowed,"
    "outcome,reason,"
    "lock_tick,position_mm,attitude_deg,false_lock_probability,candidate_false_lock_probability,"
    "candidate_right,dots_matched,min_views\n";

constexpr std::string_view kRow = "  {:<44} {:>8} {:>8} {:>9} {:>8} {:>10} {:>8}\n";

std::string heading() {
  return fmt::format(kRow, "random placements", "all", "right", "right %", "wrong", "held back",
                     "none");
}

std::string percent(std::uint64_t part, std::uint64_t all) {
  return all == 0
             ? ""
             : fmt::format("{:.2f}", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string rows(const TrialSummary& s, const std::string& title) {
  std::string text = fmt::format(kRow, title, s.placements, s.right, percent(s.right, s.placements),
                                 s.wrong, s.held_back, s.none);
  if (s.right > 0) {
    const auto row = [&](const std::string& name, std::uint64_t count) {
      text += fmt::format(kRow, "    " + name, "", count, percent(count, s.placements), "", "", "");
    };
    row("right in the first tick", s.right_in_first_tick);
    row(fmt::format("right later, within {} ticks", s.ticks_allowed),
        s.right - s.right_in_first_tick);
  }
  for (const auto& [why, count] : s.reasons) {
    const bool held = why.first == Outcome::held_back;
    text +=
        fmt::format(kRow, fmt::format("    no lock: {}", core::to_string(why.second)), "", "", "",
                    "", held ? std::to_string(count) : "", held ? "" : std::to_string(count));
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

void add(const Trial& trial, TrialSummary& summary) {
  ++summary.placements;
  summary.ticks_allowed = std::max(summary.ticks_allowed, trial.ticks_allowed);
  switch (trial.outcome) {
    case Outcome::right_lock:
      ++summary.right;
      if (trial.lock_tick == 0) ++summary.right_in_first_tick;
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
  if (!trial.locked()) ++summary.reasons[{trial.outcome, trial.reason}];
}

std::string json_of(const TrialSummary& s) {
  JsonObject reasons(2);
  for (const Outcome outcome : {Outcome::held_back, Outcome::no_lock}) {
    JsonObject of_outcome(3);
    for (const auto& [why, count] : s.reasons) {
      if (why.first == outcome) of_outcome.add(core::to_string(why.second), count);
    }
    reasons.add(to_string(outcome), of_outcome.text());
  }
  JsonObject object(1);
  object.add("placements", s.placements);
  object.add("right", s.right);
  object.add("right_in_first_tick", s.right_in_first_tick);
  object.add("wrong", s.wrong);
  object.add("held_back", s.held_back);
  object.add("none", s.none);
  object.add("reasons", reasons.text());
  return object.text();
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
    if (trial.lockable() == lockable) add(trial, summary);
  }
  return summary;
}

TrialSummary summary_of_well_lit(std::span<const Trial> trials) {
  TrialSummary summary;
  for (const Trial& trial : trials) {
    if (trial.well_lit()) add(trial, summary);
  }
  return summary;
}

bool good(std::span<const Trial> trials) {
  const TrialSummary able = summary_of(trials, true);
  return able.wrong + summary_of(trials, false).wrong == 0 &&
         (able.placements == 0 || able.right > 0);
}

LockDoubt doubt_of_locks(std::span<const Trial> trials) {
  LockDoubt doubt;
  for (const Trial& trial : trials) {
    if (!trial.locked()) continue;
    ++doubt.locks;
    doubt.expected_wrong += trial.lock_probability;
    doubt.wrong += trial.outcome == Outcome::wrong_lock ? 1U : 0U;
  }
  return doubt;
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
  const LockDoubt doubt = doubt_of_locks(trials);
  return heading() + rows(summary_of(trials, true), "lockable: enough dots truly in two views") +
         rows(summary_of_well_lit(trials), "of these: enough of them well lit") +
         rows(summary_of(trials, false), "the others") +
         fmt::format("of {} locks, {:.2g} wrong by the tracker's own estimate; {} were\n",
                     doubt.locks, doubt.expected_wrong, doubt.wrong) +
         "how often the first candidate, held back or not, was a wrong one, by the same "
         "estimate\n" +
         calibration_text(trials);
}

void add_summary(std::span<const Trial> trials, JsonObject& report) {
  report.add("placements", trials.size());
  report.add("lockable", json_of(summary_of(trials, true)));
  report.add("well_lit", json_of(summary_of_well_lit(trials)));
  report.add("others", json_of(summary_of(trials, false)));
  const LockDoubt doubt = doubt_of_locks(trials);
  report.add("locks", doubt.locks);
  report.add("wrong_locks", doubt.wrong);
  report.add("wrong_locks_expected", doubt.expected_wrong);
  std::uint64_t candidates = 0;
  std::uint64_t wrong = 0;
  double expected = 0.0;
  for (const CalibrationBin& bin : calibration_of(trials)) {
    candidates += bin.candidates;
    wrong += bin.wrong;
    expected += bin.expected_wrong;
  }
  report.add("candidates", candidates);
  report.add("wrong_candidates", wrong);
  report.add("wrong_candidates_expected", expected);
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
  return fmt::format(
      "{},{},{},{:.4f},{:.4f},{:.2f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", t.scene,
      t.seed, t.index, t.x_m, t.y_m, 180.0 / M_PI * t.yaw_rad, t.dots, t.dots_in_two_views,
      t.dots_well_lit, t.lockable() ? 1 : 0, t.ticks_allowed, to_string(t.outcome),
      core::to_string(t.reason), known(t.locked(), t.lock_tick), rounded(t.position_mm),
      rounded(t.attitude_deg), known(t.locked(), t.lock_probability),
      known(t.candidate.has_value(), candidate.false_lock_probability),
      known(t.candidate.has_value(), candidate.right ? 1 : 0), t.dots_matched, t.min_views);
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
