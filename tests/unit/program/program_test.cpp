// The program dottrack as a user meets it: exit status and what goes to which stream.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace dottrack {
namespace {

using testing::HasSubstr;

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Outcome dottrack(const std::string& arguments) {
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const auto err = folder.path() / "err";
  const std::string command = std::string("'") + DOTTRACK_PROGRAM + "' " + arguments + " >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

void expect_wrong_use(const std::string& arguments, const std::string& line) {
  const Outcome outcome = dottrack(arguments);
  EXPECT_EQ(outcome.status, 2) << arguments;
  EXPECT_EQ(outcome.out, "") << arguments;
  EXPECT_EQ(outcome.err, "dottrack: " + line + "\n") << arguments;
}

TEST(Program, AnswersWrongUseWithOneLineAndStatus2) {
  const std::string commands =
      "; expected one of replay, sim, acquisitions, experiments, consistency, light, calibrate, "
      "camera, survey, "
      "target, "
      "monitor, dbc, "
      "command, "
      "busload";
  expect_wrong_use("", "no command" + commands);
  expect_wrong_use("fly", "unknown command \"fly\"" + commands);
  expect_wrong_use("--fly", "unknown command \"--fly\"" + commands);
  expect_wrong_use("busload", "expected either RIG or --table; see dottrack busload --help");
  expect_wrong_use("camera project", "MODEL is required; see dottrack camera project --help");
  expect_wrong_use("replay rig.toml --out o", "--frames is required; see dottrack replay --help");
}

TEST(Program, AnswersWrongInputWithOneLineAndStatus2) {
  expect_wrong_use("replay none.toml --frames f --out o",
                   "none.toml: no such file; expected a rig file");
  expect_wrong_use("camera project none.cahv",
                   "none.cahv: no such file; expected a camera model in JPL's text format");
}

TEST(Program, AnswersWrongInputOfACalibrationWithOneLineAndStatus2) {
  const test::TemporaryFolder folder;
  const std::string dots = folder.write("dots.csv", "dot,x_m,y_m,z_m\na,0,0,0\n").string();
  expect_wrong_use("calibrate --images i --out o",
                   "--dots is required; see dottrack calibrate --help");
  expect_wrong_use("calibrate --dots none.csv --images i --out o",
                   "none.csv: no such file; expected a table with the headings dot,x_m,y_m,z_m (or "
                   "_cm, _mm)");
  expect_wrong_use("calibrate --out o --images none --dots " + dots,
                   "none: no such folder; expected one with the cameras' pictures");
  folder.write("frames/cam1.pgm", std::string("P5\n8 8\n255\n") + std::string(64, '0'));
  expect_wrong_use(
      "calibrate --out o --dots " + dots + " --images " + (folder.path() / "frames").string(),
      "the survey has 1 dots; expected 8 or more, not all in one plane");
}

TEST(Program, JudgesATargetByItsStatus) {
  const test::TemporaryFolder folder;
  const std::string header = "dot,x_m,y_m,z_m,diameter_m\n";
  const std::string corners = "2,-0.3,0.3,0,0.05\n3,-0.3,-0.3,0,0.05\n4,0.3,-0.3,0,0.05\n";
  folder.write("square.csv", header + "1,0.3,0.3,0,0.05\n" + corners);
  folder.write("good.csv", header + "1,0.6,0.3,0,0.05\n" + corners);
  const std::string check = "target check " + folder.path().string();
  const Outcome square = dottrack(check + "/square.csv");
  EXPECT_EQ(square.status, 1);
  EXPECT_THAT(square.out, HasSubstr("\nambiguous: move dot \"1\" by 18.6 mm"));
  EXPECT_EQ(dottrack(check + "/good.csv").status, 0);
  EXPECT_EQ(dottrack(check + "/good.csv --sigma-mm 40").status, 1);
  expect_wrong_use("target check none.csv",
                   "none.csv: no such file; expected a target file with the header "
                   "dot,x_m,y_m,z_m,diameter_m");
  expect_wrong_use("target check good.csv --rig none.toml",
                   "none.toml: no such file; expected a rig file");
}

TEST(Program, DesignsATargetThatItFindsGood) {
  const test::TemporaryFolder folder;
  const std::string out = (folder.path() / "new/panel").string();
  const Outcome outcome = dottrack("target design 4 --panel 0.5x0.4 --out " + out);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\ngood: "));
  EXPECT_EQ(dottrack("target check " + out + "/target.csv").status, 0);
  EXPECT_THAT(text_of(out + "/target.svg"), testing::StartsWith("<svg "));
  for (const char* panel : {"1.2", "0x1", "1x-1", "1x2x3", "axb", "1x101"}) {
    expect_wrong_use("target design 4 --out o --panel " + std::string(panel),
                     "--panel is \"" + std::string(panel) +
                         "\"; expected two lengths in metres, along x and y, as in 1.2x0.8");
  }
}

TEST(Program, HelpsOnStandardOutput) {
  const Outcome outcome = dottrack("--help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* command : {"replay", "sim", "experiments", "calibrate", "camera"}) {
    EXPECT_THAT(outcome.out, HasSubstr(command));
  }
}

TEST(Program, SaysItsVersion) {
  const Outcome outcome = dottrack("--version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("dottrack [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace dottrack
