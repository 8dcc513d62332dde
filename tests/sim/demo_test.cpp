// `dottrack demo` as a user runs it, inside the test's own process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/workstation/demo_command.h"
#include "app/workstation/tum_reader.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct DemoRun {
  int status = -1;
  std::string out;
  std::string err;
};

DemoRun run_demo(std::vector<std::string> arguments) {
  DemoRun run;
  CLI::App app("test", "dottrack");
  add_demo_command(app, run.status);
  arguments.insert(arguments.begin(), "demo");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes a vector
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  app.parse(arguments);
  run.out = testing::internal::GetCapturedStdout();
  run.err = testing::internal::GetCapturedStderr();
  return run;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(DemoCommandTest, TracksItsSceneAndSaysHowWell) {
  const test::TemporaryFolder folder;
  const DemoRun run = run_demo({"--out", folder.path().string(), "--ticks", "4", "--seed", "3"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("first lock               tick 0\n"));
  EXPECT_THAT(run.out, HasSubstr("tracking ticks           4\n"));
  EXPECT_THAT(run.out, HasSubstr("wrong-lock ticks         0\n"));
  EXPECT_THAT(run.out, HasSubstr((folder.path() / "replay" / "pictures").string()));
  for (const char* file : {"rig/rig.toml", "rig/target.csv", "rig/cam6.cahvor",
                           "frames/cam6/000003.pgm", "replay/report.json"}) {
    EXPECT_TRUE(fs::is_regular_file(folder.path() / file)) << file;
  }
  const auto poses = read_tum(folder.path() / "replay/poses.tum");
  const auto truth = read_tum(folder.path() / "truth.tum");
  ASSERT_TRUE(poses && truth);
  ASSERT_EQ(poses->size(), 4U);
  ASSERT_EQ(truth->size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((*poses)[i].time_s, (*truth)[i].time_s, 1e-6);
    EXPECT_LT(((*poses)[i].position_m - (*truth)[i].position_m).norm(), 0.02);
  }
}

TEST(DemoCommandTest, TheSeedChoosesTheScene) {
  const test::TemporaryFolder folder;
  const auto rig_of = [&](const std::string& name, const std::string& seed) {
    const fs::path out = folder.path() / name;
    EXPECT_EQ(run_demo({"--out", out.string(), "--ticks", "1", "--seed", seed}).status, 0);
    return contents(out / "rig/cam1.cahvor") + contents(out / "frames/cam1/000000.pgm");
  };
  const std::string first = rig_of("a", "5");
  EXPECT_GT(first.size(), 640U * 480U);
  EXPECT_EQ(rig_of("b", "5"), first);
  EXPECT_NE(rig_of("c", "6"), first);
}

TEST(DemoCommandTest, AFolderThatCannotBeMadeIsOneLine) {
  const test::TemporaryFolder folder;
  const fs::path taken = folder.write("taken", "a file");
  const DemoRun run = run_demo({"--out", taken.string(), "--ticks", "1"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("taken"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  EXPECT_EQ(run.out, "");
}

}  // namespace
}  // namespace dottrack::workstation
