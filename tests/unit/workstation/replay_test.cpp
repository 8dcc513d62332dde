// `dottrack replay` from images on disk to results on disk.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/candump/candump_line.h"
#include "tests/support/bus_listener.h"
#include "tests/support/disc_scene.h"
#include "tests/unit/workstation/replay_run.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using test::DiscScene;
using testing::Each;
using testing::HasSubstr;

constexpr std::uint64_t kTicks = 6;

class Replay : public testing::Test {
 protected:
  // The drive is drawn once for all tests; they only read it.
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    const DiscScene scene;
    scene.write_rig(folder_->path());
    test::write_drive(scene, folder_->path() / "frames", kTicks);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  ReplayRun replay(const std::string& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {(folder_->path() / "rig.toml").string(), "--frames",
                                          (folder_->path() / "frames").string(), "--out",
                                          (outs_.path() / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_replay(arguments);
  }
  fs::path out(const std::string& name) const { return outs_.path() / name; }

  static std::unique_ptr<test::TemporaryFolder> folder_;
  test::TemporaryFolder outs_;
};
std::unique_ptr<test::TemporaryFolder> Replay::folder_;

TEST_F(Replay, FollowsTheDriveAndSaysSo) {
  const ReplayRun run = replay("run");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("locked at tick 0, tracking 6 of 6 ticks"));
  EXPECT_THAT(run.out, HasSubstr("allocations in the loop: 0"));
  EXPECT_THAT(run.out, HasSubstr((out("run") / "pictures").string()));
  const std::vector<std::string> lines = lines_of(out("run") / "poses.tum");
  ASSERT_EQ(lines.size(), kTicks);
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    const std::vector<std::string> fields = split(lines[tick], ' ');
    ASSERT_EQ(fields.size(), 8U);
    const core::Pose truth = DiscScene::pose_at(tick);
    EXPECT_NEAR(std::stod(fields[0]), static_cast<double>(tick) / DiscScene::kFrameRate_hz, 1e-9);
    EXPECT_NEAR(std::stod(fields[1]), truth.position_m.x(), 0.005);
    EXPECT_NEAR(std::stod(fields[2]), truth.position_m.y(), 0.005);
    EXPECT_NEAR(std::stod(fields[3]), truth.position_m.z(), 0.005);
    const Eigen::Quaterniond q(std::stod(fields[7]), std::stod(fields[4]), std::stod(fields[5]),
                               std::stod(fields[6]));
    EXPECT_LT(q.angularDistance(truth.orientation), 0.01);
  }
}

TEST_F(Replay, ReportsWhatHappened) {
  ASSERT_EQ(replay("run").status, 0);
  const std::string report = text_of(out("run") / "report.json");
  ASSERT_TRUE(is_json(report));
  EXPECT_EQ(report_of(out("run"), "ticks"), "6");
  EXPECT_EQ(report_of(out("run"), "tracking_ticks"), "6");
  EXPECT_EQ(report_of(out("run"), "first_lock_tick"), "0");
  EXPECT_EQ(report_of(out("run"), "reacquisitions"), "0");
  EXPECT_EQ(report_of(out("run"), "deadline_misses"), "0");
  EXPECT_EQ(report_of(out("run"), "allocations_in_loop"), "0");
  EXPECT_EQ(report_of(out("run"), "allocation_trap_complete"), "true");
  EXPECT_EQ(report_of(out("run"), "bad_frames"), "0");
}

TEST_F(Replay, TheSameImagesGiveTheSameBytes) {
  ASSERT_EQ(replay("one").status, 0);
  ASSERT_EQ(replay("two").status, 0);
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out("one"))) {
    const fs::path name = fs::relative(entry.path(), out("one"));
    if (!entry.is_regular_file() || name == "report.json") continue;
    ++compared;
    EXPECT_TRUE(text_of(entry.path()) == text_of(out("two") / name)) << name;
  }
  EXPECT_EQ(compared, 4 + 2 * 4);  // poses.tum, filtered.tum, poses.csv, can.log and two
                                   // pictures a camera
}

TEST_F(Replay, RepeatShowsTheLastSetThatManyTimes) {
  ASSERT_EQ(replay("run", {"--repeat", "20"}).status, 0);
  EXPECT_EQ(report_of(out("run"), "ticks"), std::to_string(kTicks - 1 + 20));
  EXPECT_EQ(report_of(out("run"), "tracking_ticks"), std::to_string(kTicks - 1 + 20));
}

TEST_F(Replay, TheCanLogHoldsEveryPose) {
  ASSERT_EQ(replay("run").status, 0);
  const std::vector<std::string> log = lines_of(out("run") / "can.log");
  const std::vector<std::string> tum = lines_of(out("run") / "poses.tum");
  dottrack::test::BusListener listener;
  for (const std::string& line : log) {
    const auto logged = drivers::parse_candump_line(line);
    ASSERT_TRUE(logged) << line;
    listener.hear(logged->frame);
  }
  ASSERT_EQ(listener.poses().size(), kTicks);
  ASSERT_EQ(tum.size(), kTicks);
  EXPECT_EQ(listener.counts().corrupted + listener.counts().incomplete, 0U);
  for (std::size_t n = 0; n < kTicks; ++n) {
    const dottrack_pose& pose = listener.poses()[n];
    const std::vector<std::string> fields = split(tum[n], ' ');
    EXPECT_TRUE(pose.valid);
    EXPECT_NEAR(1e-6 * static_cast<double>(pose.capture_us), std::stod(fields[0]), 1.1e-6);
    EXPECT_NEAR(pose.position_m[0], std::stod(fields[1]), 0.00006);
    EXPECT_NEAR(pose.position_m[1], std::stod(fields[2]), 0.00006);
    EXPECT_NEAR(pose.orientation_wxyz[3], std::stod(fields[6]), 0.00003);
  }
}

TEST_F(Replay, EveryCameraHasAPictureOfTheFirstLockAndOfTheLastTick) {
  ASSERT_EQ(replay("run").status, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string name = DiscScene::camera_name(i) + ".png";
    const std::string last = text_of(out("run") / "pictures" / name);
    const std::string first = text_of(out("run") / "pictures" / "first_lock" / name);
    EXPECT_EQ(last.substr(1, 3), "PNG");
    EXPECT_EQ(first.substr(1, 3), "PNG");
    EXPECT_TRUE(first != last);  // the vehicle moved
  }
}

TEST_F(Replay, TheCsvHasAReasonForEveryTick) {
  ASSERT_EQ(replay("run").status, 0);
  EXPECT_EQ(column_of(out("run"), "tick").size(), kTicks);
  EXPECT_THAT(column_of(out("run"), "reason"), Each("none"));
  EXPECT_THAT(column_of(out("run"), "state"), Each("tracking"));
}

// Of four cameras only one has images.
TEST_F(Replay, ExplainsWhyThereIsNoLock) {
  const test::TemporaryFolder lonely;
  const std::string camera = DiscScene::camera_name(1);
  fs::copy(folder_->path() / "frames" / camera, lonely.path() / camera);
  const ReplayRun run =
      run_replay({(folder_->path() / "rig.toml").string(), "--frames", lonely.path().string(),
                  "--out", out("run").string(), "--explain"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("tick 0: no pose: too_few_cameras, while acquiring\n"));
  EXPECT_THAT(run.out, HasSubstr("no image\n"));
  EXPECT_THAT(run.out, HasSubstr("ticks 1 to 5: too_few_cameras still\n"));
  EXPECT_THAT(replay("whole", {"--explain"}).out, testing::Not(HasSubstr("no pose")));
}

}  // namespace
}  // namespace dottrack::workstation
