#pragma once
// What many acquisitions come to.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/workstation/json_object.h"
#include "app/workstation/trial.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct TrialSummary {
  std::uint64_t placements = 0;
  std::uint64_t right = 0;
  std::uint64_t right_in_first_tick = 0;
  std::uint64_t wrong = 0;
  std::uint64_t held_back = 0;
  std::uint64_t none = 0;
  int ticks_allowed = 0;  // the most of any trial
  // Of those without a lock: the last tick's.
  std::map<std::pair<Outcome, core::Reason>, std::uint64_t> reasons;
};

// Of those trials that were lockable, or of the others.
TrialSummary summary_of(std::span<const Trial> trials, bool lockable);
// Of those that were lockable with shadows reckoned in.
TrialSummary summary_of_well_lit(std::span<const Trial> trials);

// Never a wrong lock and, where there is something to lock on to, a right one.
bool good(std::span<const Trial> trials);

// Locks beside what the tracker itself believed of them.
struct LockDoubt {
  std::uint64_t locks = 0;
  double expected_wrong = 0.0;  // the sum of their false-lock probabilities
  std::uint64_t wrong = 0;
};
LockDoubt doubt_of_locks(std::span<const Trial> trials);

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

// The same, as members of a report.
void add_summary(std::span<const Trial> trials, JsonObject& report);

// A header and a line a trial or a bin, joinable: fields that do not apply are empty.
std::string trials_csv_header();
std::string csv_line(const Trial& trial);
std::string calibration_csv(std::span<const Trial> trials);

// Trials from the text of one acquisitions.csv, or of several, one after another. An error names
// the line.
Result<std::vector<Trial>> trials_from_csv(const std::string& text);

// An error, when some placement is there more than once.
Result<void> check_once(std::span<const Trial> trials);

}  // namespace dottrack::workstation
