#pragma once
// `dottrack replay` as a user runs it, inside the test's own process.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/workstation/replay_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/workstation/json_check.h"
#include "tests/unit/workstation/text_of.h"

namespace dottrack::workstation {

struct ReplayRun {
  int status = -1;
  std::string out;
  std::string err;
};

inline ReplayRun run_replay(std::vector<std::string> arguments) {
  ReplayRun run;
  CLI::App app("test", "dottrack");
  add_replay_command(app, run.status);
  arguments.insert(arguments.begin(), "replay");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes a vector
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  app.parse(arguments);
  run.out = testing::internal::GetCapturedStdout();
  run.err = testing::internal::GetCapturedStderr();
  return run;
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
