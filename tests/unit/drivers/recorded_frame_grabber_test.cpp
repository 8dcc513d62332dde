#include "drivers/recorded/recorded_frame_grabber.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    return RecordedFrameGrabber::open(folder_.path(), cameras);
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
};

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

}  // namespace
}  // namespace dottrack::drivers
