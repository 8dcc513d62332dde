#pragma once
// `dottrack replay` as a user runs it, inside the test's own process.

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/workstation/replay_command.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/workstation/json_check.h"

namespace dottrack::workstation {

using ReplayRun = test::ProgramRun;

inline ReplayRun run_replay(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "replay");
  return test::run_program(add_replay_command, std::move(arguments));
}

inline std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// A member of OUT/report.json.
inline std::string report_of(const std::filesystem::path& out, const std::string& key) {
  return json_member(text_of(out / "report.json"), key).value_or("no such key: " + key);
}

// A column of OUT/poses.csv, by its name.
inline std::vector<std::string> column_of(const std::filesystem::path& out,
                                          const std::string& name) {
  const std::vector<std::string> lines = lines_of(out / "poses.csv");
  const std::vector<std::string> names = split(lines.at(0), ',');
  const auto column = std::find(names.begin(), names.end(), name) - names.begin();
  std::vector<std::string> values;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    values.push_back(split(lines[i], ',').at(static_cast<std::size_t>(column)));
  }
  return values;
}

}  // namespace dottrack::workstation
