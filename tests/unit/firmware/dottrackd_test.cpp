// The program as a user starts it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/unit/config/good_rig.h"

namespace dottrack::firmware {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int status = -1;
  std::string text;  // both streams
};

Outcome run(const std::string& arguments) {
  const std::string command = std::string(DOTTRACKD) + " " + arguments + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  Outcome outcome;
  std::array<char, 512> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) {
    outcome.text.append(part.data(), size);
  }
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

TEST(Dottrackd, AWrongArgumentIsOneLineAndStatusTwo) {
  const Outcome outcome = run("--cofnig x");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--cofnig"));
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1);
}

TEST(Dottrackd, ARigFileThatIsNotThereIsNamed) {
  const Outcome outcome = run("--config /nowhere/rig.toml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.text,
            "dottrackd: error: /nowhere/rig.toml: no such file; expected a rig file\n");
}

TEST(Dottrackd, CheckTellsOfAMistakeInTheRigFile) {
  const test::RigFolder folder;
  folder.write("rig.toml", test::replaced(test::kGoodRig, "31", "32"));
  const Outcome outcome = run("--check --config " + folder.rig().string());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("rig.toml:11: background_px is 32"));
}

TEST(Dottrackd, CheckNamesEveryDeviceThatIsMissing) {
  const test::RigFolder folder;
  const Outcome outcome = run("--check --config " + folder.rig().string());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.text, HasSubstr("camera cam1: the rig file names no device"));
  EXPECT_THAT(outcome.text, HasSubstr("camera cam-2_b: no camera \"/base/i2c/imx296@1\" here"));
}

TEST(Dottrackd, CheckWarnsOfATargetThatLooksLikeItself) {
  const test::RigFolder folder;
  folder.write("target.csv",
               "dot,x_m,y_m,z_m,diameter_m\n"
               "1,0.3,0.3,0,0.05\n2,-0.3,0.3,0,0.05\n3,-0.3,-0.3,0,0.05\n4,0.3,-0.3,0,0.05\n");
  const std::string refused = run("--check --config " + folder.rig().string()).text;
  EXPECT_THAT(refused, HasSubstr("error: "));
  EXPECT_THAT(refused, HasSubstr("the target looks like itself"));
  folder.write("rig.toml",
               test::replaced(test::kGoodRig, "max_step_m", "allow_ambiguous = true\nmax_step_m"));
  EXPECT_THAT(run("--check --config " + folder.rig().string()).text,
              HasSubstr("dottrackd: warning: " + (folder.path() / "target.csv:2: ").string()));
}

TEST(Dottrackd, ARigWithoutDevicesDoesNotStart) {
  const test::RigFolder folder;
  folder.write("rig.toml", std::string(test::kGoodRig) + "[can]\ninterface = \"nocan9\"\n");
  const Outcome outcome = run("--allow-degraded --config " + folder.rig().string());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.text, StartsWith("dottrackd: error: "));
}

TEST(Dottrackd, ListsWhatTheMachineHas) {
  const Outcome outcome = run("--list-devices");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr(" cameras: one line for a [[camera]] each\n"));
  EXPECT_THAT(outcome.text, HasSubstr(" CAN interfaces: for [can]\n"));
}

}  // namespace
}  // namespace dottrack::firmware
