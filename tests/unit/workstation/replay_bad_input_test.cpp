// Images that are missing, damaged or show nothing; folders and files that are not what they should
// be. Each leads to one clear line or to ticks without a pose and with their reason.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/disc_scene.h"
#include "tests/unit/workstation/replay_run.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using test::DiscScene;
using test::flat_image;
using test::frame_path;
using test::GreyImage;
using test::noise_image;
using test::write_bytes;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ReplayBadInput : public testing::Test {
 protected:
  void SetUp() override { scene_.write_rig(folder_.path()); }

  void put(std::size_t camera, std::uint64_t tick, const GreyImage& image) {
    write_bytes(frame_path(frames_, camera, tick), image.pgm());
  }
  void put_everywhere(std::uint64_t tick, const GreyImage& image) {
    for (std::size_t camera = 0; camera < 4; ++camera) put(camera, tick, image);
  }
  ReplayRun replay(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {rig_.string(), "--frames", frames_.string(), "--out",
                                          out_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_replay(arguments);
  }
  // Nothing is found in these images: status 1, no false lock, a reason a tick, no allocation.
  std::vector<std::string> reasons_without_a_lock() {
    const ReplayRun run = replay();
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("no lock in"));
    EXPECT_EQ(text_of(out_ / "poses.tum"), "");
    EXPECT_EQ(report_of(out_, "first_lock_tick"), "-1");
    EXPECT_EQ(report_of(out_, "allocations_in_loop"), "0");
    return column_of(out_, "reason");
  }
  // Refused before anything runs: status 2, one line, no results.
  std::string refusal(const ReplayRun& run) {
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(line_count(run.err), 1U) << run.err;
    EXPECT_FALSE(fs::exists(out_ / "report.json"));
    return run.err;
  }

  DiscScene scene_;
  test::TemporaryFolder folder_;
  fs::path rig_ = folder_.path() / "rig.toml";
  fs::path frames_ = folder_.path() / "frames";
  fs::path out_ = folder_.path() / "out";
};

TEST_F(ReplayBadInput, AFrameMissingForOneCameraIsLeftOutAndCounted) {
  test::write_drive(scene_, frames_, 4);
  fs::remove(frame_path(frames_, 1, 2));
  const ReplayRun run = replay();
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(report_of(out_, "tracking_ticks"), "4");
  EXPECT_EQ(json_member(report_of(out_, "missing_frames"), "cam1"), "1");
  EXPECT_EQ(json_member(report_of(out_, "missing_frames"), "cam0"), "0");
  EXPECT_THAT(column_of(out_, "cam1_delivered"), ElementsAre("1", "1", "0", "1"));
  EXPECT_EQ(report_of(out_, "bad_frames"), "0");
}

TEST_F(ReplayBadInput, ACameraWithoutAnyImageIsOneWarning) {
  test::write_drive(scene_, frames_, 2);
  fs::remove_all(frames_ / "cam3");
  const ReplayRun run = replay();
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("cam3 holds no images"));
  EXPECT_EQ(line_count(run.err), 1U);
  EXPECT_EQ(json_member(report_of(out_, "missing_frames"), "cam3"), "2");
}

TEST_F(ReplayBadInput, ATickWithoutAnyFrameHasNoPoseAndSaysWhy) {
  test::write_drive(scene_, frames_, 4);
  for (std::size_t camera = 0; camera < 4; ++camera) fs::remove(frame_path(frames_, camera, 1));
  EXPECT_EQ(replay().status, 0);
  EXPECT_THAT(column_of(out_, "reason"), ElementsAre("none", "no_frames", "none", "none"));
  EXPECT_EQ(lines_of(out_ / "poses.tum").size(), 3U);
  const std::vector<std::string> log = lines_of(out_ / "can.log");
  EXPECT_EQ(std::ranges::count_if(
                log, [](const std::string& line) { return line.find(" 300#") != line.npos; }),
            4)
      << "a group every tick";
}

TEST_F(ReplayBadInput, OneCameraAloneIsTooFew) {
  put(0, 0, scene_.image_at(0, 0));
  EXPECT_THAT(reasons_without_a_lock(), ElementsAre("too_few_cameras"));
}

TEST_F(ReplayBadInput, DamagedImagesAreOneLineEachAndDoNotDeliver) {
  test::write_drive(scene_, frames_, 4);
  write_bytes(frame_path(frames_, 0, 1), "P5\n400 300\n255\ntruncated");
  put(1, 2, flat_image(300, 400, 50));
  write_bytes(frame_path(frames_, 2, 3), "P5\n400 300\n65535\n" + std::string(240000, 'x'));
  write_bytes(frame_path(frames_, 3, 3), "");
  const ReplayRun run = replay({"--repeat", "3"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(line_count(run.err), 4U) << run.err;
  EXPECT_THAT(run.err, HasSubstr("cam0/000001.pgm is truncated: 9 of 120000 bytes"));
  EXPECT_THAT(run.err, HasSubstr("cam1/000002.pgm is of 300 x 400 pixels"));
  EXPECT_THAT(run.err, HasSubstr("cam2/000003.pgm has 16 bits a pixel (maxval 65535)"));
  EXPECT_THAT(run.err, HasSubstr("cam3/000003.pgm does not start with P5"));
  EXPECT_THAT(run.out, HasSubstr("unreadable images: 4"));
  EXPECT_EQ(report_of(out_, "bad_frames"), "4");
  EXPECT_EQ(report_of(out_, "tracking_ticks"), "6");
  EXPECT_EQ(json_member(report_of(out_, "missing_frames"), "cam2"), "3");
}

TEST_F(ReplayBadInput, BlackImagesHaveNoLock) {
  for (std::uint64_t tick = 0; tick < 3; ++tick) put_everywhere(tick, flat_image(400, 300, 0));
  EXPECT_THAT(reasons_without_a_lock(),
              ElementsAre("too_few_regions", "too_few_regions", "too_few_regions"));
}

TEST_F(ReplayBadInput, WhiteImagesHaveNoLock) {
  for (std::uint64_t tick = 0; tick < 3; ++tick) put_everywhere(tick, flat_image(400, 300, 255));
  EXPECT_THAT(reasons_without_a_lock(), Each("too_few_regions"));
}

TEST_F(ReplayBadInput, NoiseHasNoLock) {
  for (std::uint64_t tick = 0; tick < 3; ++tick) {
    for (std::size_t camera = 0; camera < 4; ++camera) {
      put(camera, tick, noise_image(400, 300, 10 * tick + camera));
    }
  }
  EXPECT_THAT(reasons_without_a_lock(), Each(Not("none")));
}

// For six ticks of 20 ms the filter coasts; for 30 it does not.
TEST_F(ReplayBadInput, ATargetThatIsHiddenForAMomentIsNotLost) {
  test::write_drive(scene_, frames_, 12);
  for (std::uint64_t tick = 3; tick < 9; ++tick) put_everywhere(tick, flat_image(400, 300, 40));
  EXPECT_EQ(replay().status, 0);
  EXPECT_EQ(report_of(out_, "tracking_ticks"), "6");
  EXPECT_EQ(report_of(out_, "reacquisitions"), "0");
  EXPECT_EQ(column_of(out_, "state").at(8), "tracking");
  EXPECT_EQ(column_of(out_, "filter").at(8), "coasting");
}

TEST_F(ReplayBadInput, ALostTargetIsSaidToBeLostAndFoundAgain) {
  test::write_drive(scene_, frames_, 36);
  for (std::uint64_t tick = 3; tick < 33; ++tick) put_everywhere(tick, flat_image(400, 300, 40));
  EXPECT_EQ(replay().status, 0);
  EXPECT_EQ(report_of(out_, "tracking_ticks"), "6");
  EXPECT_EQ(report_of(out_, "reacquisitions"), "1");
  EXPECT_EQ(column_of(out_, "state").at(32), "acquiring");
  EXPECT_EQ(column_of(out_, "state").at(33), "tracking");
}

TEST_F(ReplayBadInput, AFolderWithoutImagesIsRefused) {
  const std::string line = refusal(replay());
  EXPECT_THAT(line, HasSubstr(frames_.string()));
  EXPECT_THAT(line, HasSubstr("<camera>/<tick, six digits>.pgm"));
}

TEST_F(ReplayBadInput, OnlyUnreadableImagesAreRefused) {
  for (std::size_t camera = 0; camera < 4; ++camera) {
    write_bytes(frame_path(frames_, camera, 0), "P6\n400 300\n255\n");
  }
  EXPECT_THAT(refusal(replay()), HasSubstr("no image can be read"));
}

TEST_F(ReplayBadInput, ARigThatIsNotThereIsRefused) {
  test::write_drive(scene_, frames_, 1);
  rig_ = folder_.path() / "absent.toml";
  EXPECT_THAT(refusal(replay()), HasSubstr("absent.toml"));
}

TEST_F(ReplayBadInput, ARigThatIsWrongIsRefusedWithItsLine) {
  test::write_drive(scene_, frames_, 1);
  write_bytes(rig_, "[rig]\nframe_rate = 30\n");
  EXPECT_THAT(refusal(replay()), HasSubstr("rig.toml"));
}

TEST_F(ReplayBadInput, AFolderForResultsThatCannotBeMadeIsRefused) {
  test::write_drive(scene_, frames_, 1);
  write_bytes(out_, "a file is in the way");
  EXPECT_THAT(refusal(replay()), HasSubstr("out: cannot make this folder"));
}

TEST_F(ReplayBadInput, AResultThatCannotBeWrittenFailsTheRun) {
  test::write_drive(scene_, frames_, 1);
  fs::create_directories(out_ / "pictures" / "cam2.png" / "in the way");
  const ReplayRun run = replay();
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(line_count(run.err), 1U);
  EXPECT_THAT(run.err, HasSubstr("pictures/cam2.png: cannot write"));
}

TEST_F(ReplayBadInput, RepeatNeedsAWholeNumberOfAtLeastOne) {
  test::write_drive(scene_, frames_, 1);
  for (const char* bad : {"0", "-3", "many", "1.5"}) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    CLI::App app("test", "dottrack");
    int status = -1;
    add_replay_command(app, status);
    std::vector<std::string> arguments = {bad,           "--repeat",       out_.string(),
                                          "--out",       frames_.string(), "--frames",
                                          rig_.string(), "replay"};
    EXPECT_THROW(app.parse(arguments), CLI::ParseError) << bad;
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
  }
}

}  // namespace
}  // namespace dottrack::workstation
