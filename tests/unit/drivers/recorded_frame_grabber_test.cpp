#include "drivers/recorded/recorded_frame_grabber.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "tests/support/disc_scene.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::drivers {
namespace {

using dottrack::test::DiscScene;
using dottrack::test::flat_image;
using dottrack::test::frame_path;
using dottrack::test::write_bytes;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kWidth_px = 8;
constexpr int kHeight_px = 6;

class RecordedFrames : public testing::Test {
 protected:
  void put(std::size_t camera, std::uint64_t tick, std::uint8_t grey) {
    write_bytes(frame_path(folder_.path(), camera, tick),
                flat_image(kWidth_px, kHeight_px, grey).pgm());
  }
  void put_bad(std::size_t camera, std::uint64_t tick) {
    write_bytes(frame_path(folder_.path(), camera, tick), "P5\n8 6\n255\nshort");
  }

  Result<std::unique_ptr<RecordedFrameGrabber>> try_open() {
    std::vector<RecordedCamera> cameras;
    for (std::size_t i = 0; i < 2; ++i) {
      cameras.push_back({DiscScene::camera_name(i), kWidth_px, kHeight_px});
    }
    return RecordedFrameGrabber::open(folder_.path(), cameras,
                                      [this](Time until) { waited_until_ = until; });
  }
  RecordedFrameGrabber& open() {
    auto opened = try_open();
    if (!opened) throw std::runtime_error(opened.error().message);
    grabber_ = std::move(*opened);
    return *grabber_;
  }

  // The greys that the cameras deliver in a tick; -1 for none.
  std::vector<int> greys(std::uint64_t tick) {
    faults_ = grabber_->load(tick);
    grabber_->trigger(Time(std::chrono::milliseconds(tick)));
    const hal::FrameSet& set = grabber_->await(CameraSet::first(2), Time{});
    std::vector<int> seen;
    for (std::size_t i = 0; i < 2; ++i) {
      seen.push_back(set.delivered.contains(i) ? set.frames[i].image.at(3, 2) : -1);
    }
    grabber_->release();
    return seen;
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<RecordedFrameGrabber> grabber_;
  std::vector<std::string> faults_;
  std::optional<Time> waited_until_;
};

Time at_ns(std::int64_t ns) {
  return Time(Duration(ns));
}

TEST_F(RecordedFrames, ShowsEachTickItsImages) {
  put(0, 0, 10);
  put(1, 0, 20);
  put(0, 1, 11);
  put(1, 1, 21);
  EXPECT_EQ(open().recorded_ticks(), 2U);
  EXPECT_THAT(greys(0), ElementsAre(10, 20));
  EXPECT_THAT(greys(1), ElementsAre(11, 21));
}

TEST_F(RecordedFrames, ShowsTheLastSetForEver) {
  put(0, 0, 10);
  put(0, 1, 11);
  put(1, 1, 21);
  open();
  for (std::uint64_t tick = 1; tick < 5; ++tick) EXPECT_THAT(greys(tick), ElementsAre(11, 21));
}

TEST_F(RecordedFrames, TheLongestRecordingCountsAndGapsDeliverNothing) {
  put(0, 0, 10);
  put(1, 3, 23);
  EXPECT_EQ(open().recorded_ticks(), 4U);
  EXPECT_THAT(greys(0), ElementsAre(10, -1));
  EXPECT_THAT(greys(1), ElementsAre(-1, -1));
  EXPECT_THAT(greys(3), ElementsAre(-1, 23));
}

TEST_F(RecordedFrames, MidExposureIsTheTrigger) {
  put(0, 0, 10);
  open().load(0);
  grabber_->trigger(Time(Duration(12345)));
  const hal::FrameSet& set = grabber_->await(CameraSet::first(2), Time{});
  EXPECT_EQ(set.frames[0].mid_exposure, Time(Duration(12345)));
}

TEST_F(RecordedFrames, ABadFileIsToldOnceCountedAndNotDelivered) {
  put(0, 0, 10);
  put(0, 1, 11);
  put_bad(1, 1);
  open();
  EXPECT_THAT(greys(0), ElementsAre(10, -1));
  EXPECT_TRUE(faults_.empty());
  EXPECT_THAT(greys(1), ElementsAre(11, -1));
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("000001.pgm is truncated")));
  EXPECT_THAT(greys(2), ElementsAre(11, -1));
  EXPECT_TRUE(faults_.empty());
  EXPECT_EQ(grabber_->bad_frames(), 1U);
}

TEST_F(RecordedFrames, OtherNamesAreNotFrames) {
  put(0, 0, 10);
  write_bytes(folder_.path() / "cam0" / "7.pgm", "x");
  write_bytes(folder_.path() / "cam0" / "0000007.pgm", "x");
  write_bytes(folder_.path() / "cam0" / "00000a.pgm", "x");
  write_bytes(folder_.path() / "cam0" / "000007.png", "x");
  EXPECT_EQ(open().recorded_ticks(), 1U);
}

TEST_F(RecordedFrames, AnEmptyFolderIsAnErrorThatSaysWhatIsExpected) {
  const auto opened = try_open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("holds no images of the rig's cameras"));
  EXPECT_THAT(opened.error().message, HasSubstr("<camera>/<tick, six digits>.pgm"));
}

TEST_F(RecordedFrames, OnlyBadFilesAreAnErrorThatNamesTheFirst) {
  put_bad(1, 0);
  put_bad(1, 4);
  const auto opened = try_open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("no image can be read: "));
  EXPECT_THAT(opened.error().message, HasSubstr("cam1/000000.pgm is truncated"));
}

TEST_F(RecordedFrames, LoadedImagesCanBeLookedAtAfterTheTick) {
  put(0, 0, 10);
  open();
  greys(0);
  EXPECT_EQ(grabber_->loaded_image(0).at(0, 0), 10);
  EXPECT_TRUE(grabber_->loaded_image(1).empty());
}

TEST_F(RecordedFrames, WithoutTimesNobodyWaits) {
  put(0, 0, 10);
  EXPECT_FALSE(open().has_times());
  greys(0);
  EXPECT_FALSE(waited_until_);
}

class TimedFrames : public RecordedFrames {
 protected:
  void put_times(const std::string& rows) {
    write_bytes(folder_.path() / "times.csv", "tick,camera,mid_exposure_ns,arrival_ns\n" + rows);
  }
  const hal::FrameSet& grab(std::uint64_t tick, Time now, Time deadline) {
    faults_ = grabber_->load(tick);
    grabber_->trigger(now);
    return grabber_->await(CameraSet::first(2), deadline);
  }
};

TEST_F(TimedFrames, HaveTheTimesOfTheRecordingAndTheLastOneIsWaitedFor) {
  put(0, 0, 10);
  put(1, 0, 20);
  put_times("0,cam0,1000,1500\n0,cam1,1010,1700\n");
  EXPECT_TRUE(open().has_times());
  const hal::FrameSet& set = grab(0, at_ns(900), at_ns(5000));
  EXPECT_EQ(set.delivered, CameraSet::first(2));
  EXPECT_EQ(set.frames[0].mid_exposure, at_ns(1000));
  EXPECT_EQ(set.frames[1].mid_exposure, at_ns(1010));
  EXPECT_EQ(waited_until_, at_ns(1700));
}

TEST_F(TimedFrames, ACameraThatDoesNotDeliverIsWaitedForUntilTheDeadline) {
  put(0, 0, 10);
  put_times("0,cam0,1000,1500\n");
  open();
  EXPECT_EQ(grab(0, at_ns(900), at_ns(5000)).delivered, CameraSet::first(1));
  EXPECT_EQ(waited_until_, at_ns(5000));
}

TEST_F(TimedFrames, AFrameAfterTheDeadlineDoesNotCount) {
  put(0, 0, 10);
  put(1, 0, 20);
  put_times("0,cam0,1000,1500\n0,cam1,1000,1700\n");
  open();
  EXPECT_EQ(grab(0, at_ns(900), at_ns(1600)).delivered, CameraSet::first(1));
  EXPECT_EQ(waited_until_, at_ns(1600));
}

TEST_F(TimedFrames, ShownAgainTheyAreOfTheNewTrigger) {
  put(0, 0, 10);
  put(1, 0, 20);
  put_times("0,cam0,1000,1500\n0,cam1,1000,1700\n");
  open();
  grab(0, at_ns(1000), at_ns(5000));
  grabber_->release();
  const hal::FrameSet& set = grab(1, at_ns(11000), at_ns(15000));
  EXPECT_EQ(set.frames[0].mid_exposure, at_ns(11000));
  EXPECT_EQ(waited_until_, at_ns(11700));
}

TEST_F(TimedFrames, AnImageWithoutALineIsToldAndNotDelivered) {
  put(0, 0, 10);
  put(1, 0, 20);
  put_times("0,cam0,1000,1500\n");
  open();
  EXPECT_EQ(grab(0, at_ns(900), at_ns(5000)).delivered, CameraSet::first(1));
  EXPECT_THAT(faults_, ElementsAre(HasSubstr("cam1/000000.pgm has no line in times.csv")));
}

struct BadTimes {
  std::string text;
  std::string complaint;
};

TEST_F(TimedFrames, AFileOfTimesThatIsWrongIsOneClearLine) {
  put(0, 0, 10);
  const std::string header = "tick,camera,mid_exposure_ns,arrival_ns\n";
  const std::string fields = "no frame's times; expected tick,camera,mid_exposure_ns,arrival_ns";
  for (const BadTimes& bad : std::vector<BadTimes>{
           {"", "cannot be read; expected tick,camera"},
           {"tick,camera,arrival_ns\n", "times.csv:1: another header; expected tick,camera"},
           {header + "0,cam0,1,2\n0,cam1,1\n", "times.csv:3: " + fields},
           {header + "0,cam0,1,2,3\n", "times.csv:2: " + fields},
           {header + "0,cam0,1,2.5\n", "times.csv:2: " + fields},
           {header + "-1,cam0,1,2\n", "times.csv:2: " + fields},
           {header + "0,,1,2\n", "times.csv:2: " + fields},
           {header + "0,cam0,3,2\n", "times.csv:2: " + fields},
           {header + "0,cam0,1,99999999999999999999\n", "times.csv:2: " + fields},
           {header + "0,cam0,1,2\n0,cam0,1,2\n", "times.csv:3: tick 0 of cam0 again"}}) {
    write_bytes(folder_.path() / "times.csv", bad.text);
    const auto opened = try_open();
    ASSERT_FALSE(opened) << bad.text;
    EXPECT_THAT(opened.error().message, HasSubstr(bad.complaint));
    EXPECT_THAT(opened.error().message, testing::Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace dottrack::drivers
