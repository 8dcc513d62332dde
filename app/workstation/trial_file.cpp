// Trials read back from acquisitions.csv.

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "app/workstation/trial_summary.h"

namespace dottrack::workstation {
namespace {

constexpr std::size_t kFields = 21;
constexpr int kReasons = 256;  // no more, of a byte
using Fields = std::array<std::string_view, kFields>;

bool split(std::string_view line, Fields& fields) {
  for (std::size_t i = 0; i < kFields; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == kFields)) return false;
    fields[i] = line.substr(0, comma);
    if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
  }
  return true;
}

template <class T>
bool read(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

template <class T>
bool read_if_there(std::string_view text, T& value) {
  return text.empty() || read(text, value);
}

// The value whose word this is, among the first `count`.
template <class Word>
bool read_word(std::string_view text, int count, Word& value) {
  for (int i = 0; i < count; ++i) {
    value = static_cast<Word>(i);
    if (to_string(value) == text) return true;
  }
  return false;
}

bool read_candidate(std::string_view probability, std::string_view right, Trial& trial) {
  if (probability.empty() != right.empty()) return false;
  if (probability.empty()) return true;
  Candidate candidate;
  if (!read(probability, candidate.false_lock_probability)) return false;
  candidate.right = right == "1";
  trial.candidate = candidate;
  return right == "0" || right == "1";
}

bool is_whole(const Trial& trial) {
  const bool lock = trial.outcome == Outcome::right_lock || trial.outcome == Outcome::wrong_lock;
  return lock == trial.locked();
}

bool read_trial(std::string_view line, Trial& trial) {
  Fields f;
  if (!split(line, f)) return false;
  double yaw_deg = 0.0;
  trial.scene = f[0];
  bool good = read(f[1], trial.seed) && read(f[2], trial.index) && read(f[3], trial.x_m) &&
              read(f[4], trial.y_m) && read(f[5], yaw_deg) && read(f[6], trial.dots) &&
              read(f[7], trial.dots_in_two_views) && read(f[8], trial.dots_well_lit) &&
              read(f[10], trial.ticks_allowed);
  good = good && read_word(f[11], kOutcomes, trial.outcome) &&
         read_word(f[12], kReasons, trial.reason);
  good = good && read_if_there(f[13], trial.lock_tick) && read_if_there(f[14], trial.position_mm) &&
         read_if_there(f[15], trial.attitude_deg) && read_if_there(f[16], trial.lock_probability);
  trial.yaw_rad = M_PI / 180.0 * yaw_deg;
  return good && read_candidate(f[17], f[18], trial) && read(f[19], trial.dots_matched) &&
         read(f[20], trial.min_views) && is_whole(trial);
}

}  // namespace

Result<std::vector<Trial>> trials_from_csv(const std::string& text) {
  std::vector<Trial> trials;
  const std::string header = trials_csv_header();
  std::string_view rest = text;
  if (!rest.starts_with(header)) {
    return fail(fmt::format("line 1: expected the header of an acquisitions.csv, {}...",
                            header.substr(0, 24)));
  }
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line == std::string_view(header).substr(0, header.size() - 1)) continue;
    Trial trial;
    if (!read_trial(line, trial)) {
      return fail(
          fmt::format("line {} is no line of an acquisitions.csv; expected {} fields as in "
                      "the header",
                      number, kFields));
    }
    trials.push_back(trial);
  }
  return trials;
}

Result<void> check_once(std::span<const Trial> trials) {
  std::set<std::tuple<std::string_view, std::uint64_t, std::uint64_t>> seen;
  for (const Trial& trial : trials) {
    if (seen.emplace(trial.scene, trial.seed, trial.index).second) continue;
    return fail(fmt::format("placement {} of {}, seed {}, is there twice; expected each once",
                            trial.index, trial.scene, trial.seed));
  }
  return {};
}

}  // namespace dottrack::workstation
