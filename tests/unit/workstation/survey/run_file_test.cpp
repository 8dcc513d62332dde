#include "app/workstation/survey/run_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

// Two cameras, three dots: of which only the numbers matter here.
config::RigConfig small_rig() {
  config::RigConfig rig;
  for (const char* name : {"left", "right"}) rig.cameras.push_back({name, {}});
  rig.rig.cameras.resize(2);
  rig.rig.target.dots.resize(3);
  return rig;
}

std::string header() {
  std::string text = "tick,x_m,y_m,z_m,qx,qy,qz,qw,left_moved,right_moved";
  for (int dot = 0; dot < 3; ++dot) {
    for (const char* camera : {"left", "right"}) {
      text += fmt::format(",dot{0}_{1}_x_px,dot{0}_{1}_y_px", dot, camera);
    }
  }
  return text + "\n";
}

TEST(RunFile, HasThePosesAndWhatWasSeen) {
  const test::TemporaryFolder folder;
  folder.write("poses.csv", header() + "0,,,,,,,,0,0,,,,,,,,,,,,\n" +
                                "7,1.5,2,3,0,0,0,1,0,1,10.5,11,,,,,20,21,,,30,31\n");
  const auto ticks = read_run(folder.path(), small_rig());
  ASSERT_TRUE(ticks) << ticks.error().message;
  ASSERT_EQ(ticks->size(), 1U);
  const RecordedTick& tick = ticks->front();
  EXPECT_EQ(tick.tick, 7U);
  EXPECT_EQ(tick.pose.position_m, Eigen::Vector3d(1.5, 2.0, 3.0));
  EXPECT_EQ(tick.pose.orientation.w(), 1.0);
  ASSERT_EQ(tick.views.size(), 3U);
  EXPECT_EQ(tick.views[0].pixel, Eigen::Vector2d(10.5, 11.0));
  EXPECT_FALSE(tick.views[0].moved);
  EXPECT_EQ(tick.views[1].camera, 1U);
  EXPECT_EQ(tick.views[1].dot, 1U);
  EXPECT_TRUE(tick.views[1].moved);
}

std::string complaint(const std::string& text) {
  const test::TemporaryFolder folder;
  const auto ticks = read_run(folder.write("poses.csv", text), small_rig());
  if (ticks) return "none";
  return ticks.error().message.substr(ticks.error().message.find("poses.csv"));
}

TEST(RunFile, SaysWhatIsWrongInOneLine) {
  EXPECT_EQ(complaint(""), "poses.csv: cannot be read; expected poses.csv of a run");
  EXPECT_EQ(complaint("tick,x_m,y_m\n"),
            "poses.csv:1: no column z_m; expected poses.csv of a run of this rig");
  EXPECT_EQ(complaint(header() + "1,2\n"),
            "poses.csv:2: not a line of poses.csv; expected 22 numbers and words");
  EXPECT_EQ(complaint(header() + "7,1.5,2,three,0,0,0,1,0,1,10.5,11,,,,,20,21,,,30,31\n"),
            "poses.csv:2: not a line of poses.csv; expected 22 numbers and words");
  EXPECT_EQ(read_run("no/such/folder", small_rig()).error().message,
            "no/such/folder: cannot be read; expected poses.csv of a run");
}

}  // namespace
}  // namespace dottrack::workstation
