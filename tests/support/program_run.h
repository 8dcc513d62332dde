#pragma once
// A command of the program as a user runs it, inside the test's own process.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace dottrack::test {

struct ProgramRun {
  int status = -1;
  std::string out;
  std::string err;
};

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
