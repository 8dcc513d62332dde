// Trials read back from acquisitions.csv.

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

#include "app/workstation/trial_summary.h"

namespace dottrack::workstation {
namespace {

constexpr std::size_t kFields = 14;
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

bool read_trial(std::string_view line, Trial& trial) {
  Fields f;
  if (!split(line, f)) return false;
  double yaw_deg = 0.0;
  bool good = read(f[0], trial.index) && read(f[1], trial.x_m) && read(f[2], trial.y_m) &&
              read(f[3], yaw_deg) && read(f[4], trial.dots) && read(f[5], trial.dots_in_two_views);
  good = good && read_word(f[7], 4, trial.outcome) && read_word(f[8], 16, trial.reason);
  good = good && read_if_there(f[9], trial.lock_tick) && read_if_there(f[10], trial.position_mm) &&
         read_if_there(f[11], trial.attitude_deg);
  trial.yaw_rad = M_PI / 180.0 * yaw_deg;
  if (!good || f[12].empty()) return good;
  Candidate candidate;
  if (!read(f[12], candidate.false_lock_probability)) return false;
  candidate.right = f[13] == "1";
  trial.candidate = candidate;
  return true;
}

}  // namespace

Result<std::vector<Trial>> trials_from_csv(const std::string& text) {
  std::vector<Trial> trials;
  std::set<std::uint64_t> seen;
  const std::string header = trials_csv_header();
  std::string_view rest = text;
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
    if (!seen.insert(trial.index).second) {
      return fail(fmt::format("line {}: index {} is there twice; expected each placement once",
                              number, trial.index));
    }
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace dottrack::workstation
