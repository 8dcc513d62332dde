#pragma once
// `dottrack sim` on a small scenario, in a folder of the test's own.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/workstation/sim_command.h"
#include "tests/sim/small_scenario.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {

inline test::ProgramRun run_sim(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "sim");
  return test::run_program(add_sim_command, std::move(arguments));
}

class SmallScenario : public testing::Test {
 protected:
  std::string scenario(const std::string& more = "") const {
    return folder_.write("small.toml", test::small_scenario(more)).string();
  }
  std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  test::TemporaryFolder folder_;
};

}  // namespace dottrack::workstation
