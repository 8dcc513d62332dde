#pragma once
// What many acquisitions come to.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/trials.h"

namespace dottrack::workstation {

struct TrialSummary {
  std::uint64_t placements = 0;
  std::uint64_t right = 0;
  std::uint64_t wrong = 0;
  std::uint64_t held_back = 0;
  std::uint64_t none = 0;
  std::map<std::string, std::uint64_t> reasons;    // of those without a lock, held back or not
  std::map<int, std::uint64_t> right_after_ticks;  // right locks by the ticks that they took
};

// Of those trials that were lockable, or of the others.
TrialSummary summary_of(std::span<const Trial> trials, bool lockable);

// Candidates whose false-lock probability p lies in (from, to].
struct CalibrationBin {
  double from = 0.0;
  double to = 1.0;
  std::uint64_t candidates = 0;
  double expected_wrong = 0.0;  // the sum of their probabilities
  std::uint64_t wrong = 0;

  double mean_probability() const { return per_candidate(expected_wrong); }
  double wrong_rate() const { return per_candidate(static_cast<double>(wrong)); }
  // Whether so few wrong ones are expected that their number says little. More of them than
  // expected always say something.
  bool too_few_to_show() const {
    return expected_wrong < kLeastExpected && static_cast<double>(wrong) <= kLeastExpected;
  }
  double per_candidate(double sum) const {
    return candidates == 0 ? 0.0 : sum / static_cast<double>(candidates);
  }

  static constexpr double kLeastExpected = 3.0;
};

// By decade, from the most to the least probably false; the last bin takes all below its upper end.
inline constexpr int kCalibrationDecades = 13;
std::array<CalibrationBin, kCalibrationDecades> calibration_of(std::span<const Trial> trials);

// For a person: what became of the placements, and the calibration of what the tracker thought.
std::string summary_text(std::span<const Trial> trials);

// A header and a line a trial or a bin, joinable: fields that do not apply are empty.
std::string trials_csv_header();
std::string csv_line(const Trial& trial);
std::string calibration_csv(std::span<const Trial> trials);

// Trials from the texts of one or several acquisitions.csv.
Result<std::vector<Trial>> trials_from_csv(const std::string& text);

}  // namespace dottrack::workstation
