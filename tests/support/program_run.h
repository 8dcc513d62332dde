#pragma once
// A command of the program as a user runs it, inside the test's own process.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace dottrack::test {

struct ProgramRun {
  int status = -1;
  std::string out;
  std::string err;
};

// Whether a command said no more on standard error than what it doubts of its input.
inline bool only_warnings(const std::string& err) {
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("dottrack: warning: ")) return false;
  }
  return true;
}

using AddCommand = std::function<void(CLI::App&, int&)>;

// `arguments`: from the command's name on.
inline ProgramRun run_program(const AddCommand& add, std::vector<std::string> arguments) {
  ProgramRun run;
  CLI::App app("test", "dottrack");
  add(app, run.status);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes a vector
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  app.parse(arguments);
  run.out = testing::internal::GetCapturedStdout();
  run.err = testing::internal::GetCapturedStderr();
  return run;
}

}  // namespace dottrack::test
