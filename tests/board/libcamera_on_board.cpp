// The cameras that this machine has, whatever they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "drivers/libcamera/libcamera_grabber.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::test {
namespace {

using drivers::CameraListing;
using drivers::LibcameraGrabber;
using drivers::LibcameraSettings;

constexpr std::size_t kMostCameras = 3;
constexpr int kTicks = 20;
constexpr Duration kPeriod = std::chrono::milliseconds(333);
constexpr Duration kStartUp = std::chrono::seconds(10);

// "640x480 R8", say.
bool read_size(const std::string& text, LibcameraSettings& settings) {
  return std::sscanf(text.c_str(), "%dx%d", &settings.width_px, &settings.height_px) == 2;
}

std::vector<LibcameraSettings> first_cameras(const std::vector<CameraListing>& listings) {
  std::vector<LibcameraSettings> cameras;
  for (const CameraListing& listing : listings) {
    LibcameraSettings settings;
    settings.name = "cam" + std::to_string(cameras.size() + 1);
    settings.id = listing.id;
    settings.exposure = {.exposure = std::chrono::milliseconds(5), .gain = 1.0};
    if (listing.sizes.empty() || !read_size(listing.sizes.front(), settings)) continue;
    if (cameras.size() < kMostCameras) cameras.push_back(settings);
  }
  return cameras;
}

LibcameraSettings nowhere() {
  LibcameraSettings settings;
  settings.name = "north";
  settings.id = "nowhere";
  settings.width_px = 640;
  settings.height_px = 480;
  return settings;
}

class CamerasOfThisMachine : public testing::Test {
 protected:
  void SetUp() override {
    const auto listings = drivers::list_cameras();
    ASSERT_TRUE(listings) << listings.error().message;
    settings_ = first_cameras(*listings);
    if (settings_.empty()) GTEST_SKIP() << "no camera on this machine";
  }

  auto open(bool allow_missing = false) {
    return LibcameraGrabber::open(settings_, kPeriod, nullptr, allow_missing, clock_);
  }

  // A tick that waits as long as it may; the cameras' rate is not known.
  const hal::FrameSet& grab(LibcameraGrabber& grabber, Duration patience) {
    grabber.trigger(clock_.now());
    return grabber.await(all(), clock_.now() + patience);
  }

  // Until every camera delivers.
  void start_up(LibcameraGrabber& grabber) {
    const Time end = clock_.now() + kStartUp;
    while (grab(grabber, kPeriod).delivered != all() && clock_.now() < end) grabber.release();
    grabber.release();
  }

  CameraSet all() const { return CameraSet::first(settings_.size()); }

  rtos::MonotonicClock clock_;
  std::vector<LibcameraSettings> settings_;
};

TEST_F(CamerasOfThisMachine, DeliverImagesOfTheSizeAskedForWithStampsThatIncrease) {
  const auto grabber = open();
  ASSERT_TRUE(grabber) << grabber.error().message;
  start_up(**grabber);
  std::array<Time, kMaxCameras> last{};
  int complete = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const hal::FrameSet& set = grab(**grabber, kPeriod);
    complete += set.delivered == all() ? 1 : 0;
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      if (!set.delivered.contains(i)) continue;
      const hal::Frame& frame = set.frames[i];
      EXPECT_EQ(frame.image.width_px, settings_[i].width_px);
      EXPECT_EQ(frame.image.height_px, settings_[i].height_px);
      EXPECT_GE(frame.image.stride_bytes, frame.image.width_px);
      EXPECT_GE(frame.image.at(frame.image.width_px - 1, frame.image.height_px - 1), 0);
      EXPECT_GT(frame.mid_exposure, last[i]);
      EXPECT_LT(frame.mid_exposure, clock_.now());
      last[i] = frame.mid_exposure;
    }
    (*grabber)->release();
  }
  EXPECT_GE(complete, kTicks / 2);
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const drivers::CameraHealth health = (*grabber)->health(i);
    EXPECT_TRUE(health.present);
    EXPECT_GE(health.frames, static_cast<std::uint64_t>(complete));
    EXPECT_EQ(health.errors, 0U);
    EXPECT_EQ(health.departures, 0U);
    std::printf("%s: %llu frames, %llu gaps, %llu late\n", settings_[i].id.c_str(),
                static_cast<unsigned long long>(health.frames),
                static_cast<unsigned long long>(health.gaps),
                static_cast<unsigned long long>(health.late));
  }
}

TEST_F(CamerasOfThisMachine, TheTickLeavesTheHeapAlone) {
  const auto grabber = open();
  ASSERT_TRUE(grabber) << grabber.error().message;
  start_up(**grabber);
  int frames = 0;
  const rtos::AllocationTrap::Scope armed;
  for (int tick = 0; tick < kTicks; ++tick) {
    frames += grab(**grabber, kPeriod).delivered.size();
    (*grabber)->set_exposure(0, {.exposure = std::chrono::milliseconds(4 + tick % 2), .gain = 1.0});
    (*grabber)->release();
  }
  EXPECT_EQ(armed.calls().total(), 0U);
  EXPECT_GT(frames, 0);
}

TEST_F(CamerasOfThisMachine, CanBeClosedAndOpenedAgain) {
  for (int round = 0; round < 3; ++round) {
    const auto grabber = open();
    ASSERT_TRUE(grabber) << grabber.error().message;
    start_up(**grabber);
    EXPECT_EQ((*grabber)->health(0).errors, 0U);
    EXPECT_GT((*grabber)->health(0).frames, 0U);
  }
}

TEST_F(CamerasOfThisMachine, ACameraHasOneGrabberAtATime) {
  const auto first = open();
  ASSERT_TRUE(first) << first.error().message;
  const auto second = open();
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find(settings_[0].id), std::string::npos);
}

TEST_F(CamerasOfThisMachine, ASizeThatIsNotOfferedIsAnErrorThatListsWhatIs) {
  settings_[0].width_px += 2;
  const auto grabber = open();
  ASSERT_FALSE(grabber);
  EXPECT_NE(grabber.error().message.find("it offers"), std::string::npos)
      << grabber.error().message;
}

TEST_F(CamerasOfThisMachine, ACameraThatIsNotThereIsAnErrorOrWaitedForWithoutBlockingTheOthers) {
  settings_.back().id = "no such camera";
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("no such camera"), std::string::npos);
  const auto grabber = open(true);
  ASSERT_TRUE(grabber) << grabber.error().message;
  EXPECT_FALSE((*grabber)->health(settings_.size() - 1).present);
}

TEST(CamerasOfAnyMachine, ThatAreNotThereAreAnError) {
  const rtos::MonotonicClock clock;
  const LibcameraSettings settings = nowhere();
  const auto refused = LibcameraGrabber::open({settings}, kPeriod, nullptr, false, clock);
  ASSERT_FALSE(refused);
  EXPECT_NE(
      refused.error().message.find("camera north: there is no camera with the id \"nowhere\""),
      std::string::npos)
      << refused.error().message;
}

TEST(CamerasOfAnyMachine, ThatAreStillToComeLeaveTheTickEmptyAndAreNotWaitedFor) {
  const rtos::MonotonicClock clock;
  const LibcameraSettings settings = nowhere();
  const auto grabber = LibcameraGrabber::open({settings}, kPeriod, nullptr, true, clock);
  ASSERT_TRUE(grabber) << grabber.error().message;
  const Time before = clock.now();
  (*grabber)->trigger(before);
  EXPECT_TRUE((*grabber)->await(CameraSet(1), before + std::chrono::hours(1)).delivered.empty());
  (*grabber)->release();
  EXPECT_FALSE((*grabber)->health(0).present);
}

}  // namespace
}  // namespace dottrack::test
