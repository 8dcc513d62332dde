#include "app/telemetry/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/telemetry/record_of.h"

namespace dottrack::telemetry {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RecordingTest : public testing::Test {
 protected:
  std::unique_ptr<Recording> open(bool frames) {
    RecordingSettings settings{.folder = folder_.path() / "kept",
                               .frames = frames,
                               .min_free_bytes = 1000,
                               .cameras = {"north"},
                               .dots = 1};
    return std::make_unique<Recording>(settings, frames ? &ring_ : nullptr,
                                       [this](const fs::path&) { return free_; });
  }
  void frame(std::uint64_t tick) {
    const std::array<std::uint8_t, 6> pixels{1, 2, 3, 4, 5, static_cast<std::uint8_t>(tick)};
    hal::FrameSet set;
    set.frames[0] = {{pixels.data(), 3, 2, 3}, Time(Duration(40)), 0};
    set.delivered.insert(0);
    ASSERT_TRUE(ring_.try_push(tick, Time(Duration(50)), set));
  }
  fs::path run(const std::string& number) const { return folder_.path() / "kept" / number; }

  test::TemporaryFolder folder_;
  std::vector<FrameSize> sizes_{{3, 2}};
  FrameRing ring_{sizes_, 4};
  std::optional<std::uint64_t> free_ = 5000;
};

TEST_F(RecordingTest, KeepsPosesAndFramesAsAReplayReadsThem) {
  {
    const auto recording = open(true);
    for (std::uint64_t tick = 20; tick < 22; ++tick) {
      recording->write(record_with_pose(tick));
      frame(tick);
      recording->settle();
    }
    EXPECT_TRUE(recording->running());
    EXPECT_EQ(recording->lost_ticks() + recording->lost_frames(), 0U);
  }
  EXPECT_EQ(lines_of(run("run-000001") / "poses.tum").size(), 2U);
  EXPECT_EQ(lines_of(run("run-000001") / "poses.csv").size(), 3U);
  const fs::path frames = run("run-000001") / "frames";
  EXPECT_EQ(text_of(frames / "north/000000.pgm"), std::string("P5\n3 2\n255\n\1\2\3\4\5\24", 17));
  EXPECT_EQ(text_of(frames / "north/000001.pgm").back(), '\25');
  EXPECT_EQ(text_of(frames / "times.csv"),
            "tick,camera,mid_exposure_ns,arrival_ns\n0,north,40,50\n1,north,40,50\n");
}

TEST_F(RecordingTest, EveryStartHasAFolderOfItsOwn) {
  for (const std::string number : {"run-000001", "run-000002"}) {
    const auto recording = open(false);
    recording->write(record_with_pose(0));
    EXPECT_TRUE(fs::is_directory(run(number)));
  }
}

TEST_F(RecordingTest, AFullDiskEndsTheRunKeepsItAndCountsWhatIsLost) {
  const auto recording = open(true);
  recording->write(record_with_pose(0));
  frame(0);
  recording->settle();
  free_ = 999;
  for (std::uint64_t tick = 1; tick < 6; ++tick) {
    recording->write(record_with_pose(tick));
    frame(tick);
    recording->settle();
  }
  EXPECT_FALSE(recording->running());
  EXPECT_EQ(recording->lost_ticks(), 5U);
  EXPECT_EQ(recording->lost_frames(), 5U);
  EXPECT_THAT(recording->fault(), HasSubstr("the disk is full"));
  EXPECT_EQ(lines_of(run("run-000001") / "poses.tum").size(), 1U);
  EXPECT_TRUE(fs::exists(run("run-000001") / "frames/times.csv"));
}

TEST_F(RecordingTest, GoesOnInANewRunWhenThereIsRoomAgain) {
  const auto recording = open(false);
  recording->write(record_with_pose(0));
  free_ = 0;
  for (std::uint64_t tick = 1; tick < 4; ++tick) recording->write(record_with_pose(tick));
  free_ = 5000;
  std::uint64_t tick = 4;
  for (; !recording->running() && tick < 200; ++tick) recording->write(record_with_pose(tick));
  EXPECT_TRUE(recording->running());
  EXPECT_EQ(recording->fault(), "");
  EXPECT_EQ(recording->lost_ticks(), tick - 2);
  recording->settle();
  EXPECT_TRUE(fs::is_directory(run("run-000002")));
}

TEST_F(RecordingTest, AFolderThatCannotBeMadeIsToldAndLosesTheRecordsOnly) {
  folder_.write("kept", "a file stands where the folder should be");
  const auto recording = open(false);
  recording->write(record_with_pose(0));
  EXPECT_FALSE(recording->running());
  EXPECT_EQ(recording->lost_ticks(), 1U);
  EXPECT_THAT(recording->fault(), HasSubstr("kept: cannot make a folder there"));
}

TEST_F(RecordingTest, ADiskThatDoesNotTellItsSpaceIsTriedAllTheSame) {
  free_.reset();
  const auto recording = open(false);
  recording->write(record_with_pose(0));
  EXPECT_TRUE(recording->running());
}

}  // namespace
}  // namespace dottrack::telemetry
