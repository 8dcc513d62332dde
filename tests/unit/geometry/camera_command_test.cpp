// dottrack camera as a filter of lines.

#include "app/workstation/camera_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "app/config/camera_file.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Looks along +z from the origin.
const geometry::CameraModel kModel =
    geometry::Cahv{{0, 0, 0}, {0, 0, 1}, {500, 0, 320}, {0, 500, 240}};
const std::string kProjectHeader = "X,Y,Z,status,x,y,dx_dX,dx_dY,dx_dZ,dy_dX,dy_dY,dy_dZ";
const std::string kUnprojectHeader =
    "x,y,status,ox,oy,oz,ux,uy,uz,dox_dx,dox_dy,doy_dx,doy_dy,doz_dx,doz_dy,"
    "dux_dx,dux_dy,duy_dx,duy_dy,duz_dx,duz_dy";

struct Answer {
  std::vector<std::string> lines;
  std::string error;
};

using LineFilter = Result<void> (*)(const geometry::CameraModel&, std::istream&, std::ostream&);

Answer run(LineFilter filter, const std::string& input) {
  std::istringstream in(input);
  std::ostringstream out;
  const Result<void> result = filter(kModel, in, out);
  Answer answer;
  if (!result) answer.error = result.error().message;
  std::istringstream text(out.str());
  for (std::string line; std::getline(text, line);) answer.lines.push_back(line);
  return answer;
}

TEST(CameraCommand, ProjectsWithPartialDerivatives) {
  EXPECT_THAT(run(project_lines, "1,2,4\n").lines,
              ElementsAre(kProjectHeader, "1,2,4,ok,445,490,125,0,-31.25,0,125,-62.5"));
}

TEST(CameraCommand, UnprojectsWithPartialDerivatives) {
  const Answer r = run(unproject_lines, "320,240\n");
  ASSERT_EQ(r.lines.size(), 2U);
  EXPECT_EQ(r.lines[0], kUnprojectHeader);
  const std::string start = "320,240,ok,";
  ASSERT_THAT(r.lines[1], testing::StartsWith(start));
  std::istringstream fields(r.lines[1].substr(start.size()));
  std::vector<double> numbers;
  for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
  EXPECT_THAT(numbers, ElementsAre(0, 0, 0, 0, 0, 1,         // origin, direction
                                   0, 0, 0, 0, 0, 0,         // d(origin)
                                   0.002, 0, 0, 0.002, 0, 0  // d(direction)
                                   ));
}

TEST(CameraCommand, WritesSeventeenDigits) {
  EXPECT_THAT(run(project_lines, "0.1,0,3\n").lines.at(1),
              testing::StartsWith("0.10000000000000001,0,3,ok,336.66666666666669,240,"));
}

TEST(CameraCommand, LeavesNumbersEmptyWhereThereAreNone) {
  EXPECT_THAT(run(project_lines, "0,0,-1\n0,0,0\nnan,0,1\n1,inf,1\n").lines,
              ElementsAre(kProjectHeader, "0,0,-1,behind,,,,,,,,", "0,0,0,at_centre,,,,,,,,",
                          "nan,0,1,not_finite,,,,,,,,", "1,inf,1,not_finite,,,,,,,,"));
  const Answer r = run(unproject_lines, "nan,3\n");
  EXPECT_EQ(r.lines.at(1), "nan,3,not_finite" + std::string(18, ','));
}

TEST(CameraCommand, EveryRowIsAsWideAsTheHeader) {
  const auto commas = [](const std::string& s) { return std::count(s.begin(), s.end(), ','); };
  for (const std::string& line : run(project_lines, "1,2,3\n1,2,-3\n0,0,0\n").lines) {
    EXPECT_EQ(commas(line), commas(kProjectHeader)) << line;
  }
  for (const std::string& line : run(unproject_lines, "1,2\nnan,2\n").lines) {
    EXPECT_EQ(commas(line), commas(kUnprojectHeader)) << line;
  }
}

TEST(CameraCommand, PassesOverAHeaderBlankLinesAndCarriageReturns) {
  const Answer r = run(project_lines, "X,Y,Z\r\n\r\n 0 , 0,\t+2 \r\n\n0,0,4");
  EXPECT_EQ(r.error, "");
  ASSERT_EQ(r.lines.size(), 3U);
  EXPECT_THAT(r.lines[1], HasSubstr("0,0,2,ok,320,240,"));
  EXPECT_THAT(r.lines[2], HasSubstr("0,0,4,ok,320,240,"));
}

TEST(CameraCommand, OfNothingWritesAHeader) {
  EXPECT_THAT(run(project_lines, "").lines, ElementsAre(kProjectHeader));
  EXPECT_THAT(run(unproject_lines, "x,y\n").lines, ElementsAre(kUnprojectHeader));
}

TEST(CameraCommand, NamesTheLineItCannotRead) {
  const auto error = [](const std::string& input) { return run(project_lines, input).error; };
  EXPECT_EQ(error("0,0,2\n1,2\n"), "standard input:2: \"1,2\"; expected X,Y,Z, three numbers");
  EXPECT_THAT(error("X,Y,Z\n1,2,3\n1,2,x\n"), HasSubstr("standard input:3: "));
  EXPECT_THAT(error("1,2,x\n"), HasSubstr("standard input:1: "));
  EXPECT_THAT(error("1,2,3,4\n"), HasSubstr("standard input:1: "));
  EXPECT_THAT(error("1,2,3\nX,Y,Z\n"), HasSubstr("standard input:2: "));
  EXPECT_THAT(error("1,,3\n"), HasSubstr("standard input:1: "));
  EXPECT_THAT(error("1 2 3\n1 2 3\n"), HasSubstr("standard input:2: "));
  EXPECT_EQ(run(unproject_lines, "1,2,3\n").error,
            "standard input:1: \"1,2,3\"; expected x,y, two numbers");
}

TEST(CameraCommand, KeepsTheRowsBeforeAnError) {
  EXPECT_EQ(run(project_lines, "0,0,2\nbad\n").lines.size(), 2U);
}

// Hands out one line at a time and notes how many were answered before it was asked for more.
class Dialogue : public std::streambuf {
 public:
  Dialogue(std::vector<std::string> lines, const std::ostringstream& answers)
      : lines_(std::move(lines)), answers_(answers) {}

  std::vector<long> answered;

 protected:
  int_type underflow() override {
    const std::string so_far = answers_.str();
    answered.push_back(std::count(so_far.begin(), so_far.end(), '\n'));
    if (next_ == lines_.size()) return traits_type::eof();
    std::string& line = lines_[next_++];
    setg(line.data(), line.data(), line.data() + line.size());
    return traits_type::to_int_type(line.front());
  }

 private:
  std::vector<std::string> lines_;
  const std::ostringstream& answers_;
  std::size_t next_ = 0;
};

TEST(CameraCommand, AnswersALineBeforeItReadsTheNext) {
  std::ostringstream out;
  Dialogue dialogue({"X,Y,Z\n", "0,0,1\n", "0,0,-1\n"}, out);
  std::istream in(&dialogue);
  ASSERT_TRUE(project_lines(kModel, in, out).has_value());
  EXPECT_THAT(dialogue.answered, ElementsAre(1, 1, 2, 3));
}

// The command as main() runs it, on these bytes of standard input.
class Command {
 public:
  explicit Command(const std::string& input) : in_(input) {
    std::ios::sync_with_stdio(false);  // the command's own call then leaves the buffers in place
    cin_ = std::cin.rdbuf(in_.rdbuf());
    cout_ = std::cout.rdbuf(out.rdbuf());
  }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command() {
    std::cin.rdbuf(cin_);
    std::cout.rdbuf(cout_);
    std::cin.clear();
    std::cout.clear();
  }

  int run(const std::string& direction, const std::string& model) {
    CLI::App app;
    int exit_status = -1;
    add_camera_command(app, exit_status);
    testing::internal::CaptureStderr();
    app.parse("camera " + direction + " \"" + model + "\"");
    error = testing::internal::GetCapturedStderr();
    return exit_status;
  }

  std::ostringstream out;
  std::string error;

 private:
  std::istringstream in_;
  std::streambuf* cin_;
  std::streambuf* cout_;
};

class CameraCommandLine : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::string model_ =
      folder_.write("cam.cahv", config::write_camera_text({kModel, {}, "", {}})).string();
};

TEST_F(CameraCommandLine, ReadsAModelAndStandardInput) {
  Command command("1,2,4\n");
  EXPECT_EQ(command.run("project", model_), 0);
  EXPECT_EQ(command.out.str(), kProjectHeader + "\n1,2,4,ok,445,490,125,0,-31.25,0,125,-62.5\n");
  EXPECT_EQ(command.error, "");
}

TEST_F(CameraCommandLine, EndsWithStatusTwoOnAWrongLine) {
  Command command("320,240\n320\n");
  EXPECT_EQ(command.run("unproject", model_), 2);
  EXPECT_EQ(command.error, "dottrack: standard input:2: \"320\"; expected x,y, two numbers\n");
}

TEST_F(CameraCommandLine, EndsWithStatusTwoOnAWrongModel) {
  Command command("");
  const auto bad = folder_.write("bad.cahv", "\nC = 1 2\n").string();
  EXPECT_EQ(command.run("project", bad), 2);
  EXPECT_EQ(command.error, "dottrack: " + bad + ":2: C has 2 numbers; expected three numbers\n");
  EXPECT_EQ(command.out.str(), "");
}

TEST_F(CameraCommandLine, EndsWithStatusOneWhenNobodyTakesTheOutput) {
  Command command("0,0,1\n");
  std::cout.setstate(std::ios::badbit);
  EXPECT_EQ(command.run("project", model_), 1);
  EXPECT_EQ(command.error, "dottrack: standard output cannot be written\n");
}

}  // namespace
}  // namespace dottrack::workstation
