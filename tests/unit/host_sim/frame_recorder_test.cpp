// A recording and its replay: the same frames at the same times.

#include "host_sim/hal/frame_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "drivers/recorded/recorded_frame_grabber.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::host_sim {
namespace {

using std::chrono::milliseconds;

constexpr int kTicks = 12;
constexpr CameraSet kAll = CameraSet::first(2);

// What a tick of either kind of grabber came to.
struct Seen {
  CameraSet delivered;
  std::vector<Time> mid_exposures;
  std::vector<int> greys;
  Time after;

  bool operator==(const Seen&) const = default;
};

Time due(int tick) {
  return Time(milliseconds(100) * tick);
}

Seen grab(hal::FrameGrabber& grabber, rtos::VirtualClock& clock, int tick) {
  clock.jump_to(due(tick));
  grabber.trigger(clock.now());
  const hal::FrameSet& set = grabber.await(kAll, due(tick) + milliseconds(50));
  Seen seen{set.delivered, {}, {}, clock.now()};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!set.delivered.contains(i)) continue;
    seen.mid_exposures.push_back(set.frames[i].mid_exposure);
    seen.greys.push_back(set.frames[i].image.at(3, 3));
  }
  grabber.release();
  return seen;
}

SimGrabberSetup setup() {
  SimGrabberSetup setup;
  setup.cameras.resize(2);
  setup.model.jitter_s = 0.005;
  setup.model.drop_share = 0.1;
  setup.faults = {{0, CameraFaultKind::dead, 0.2, 0.4}, {1, CameraFaultKind::late, 0.5, 0.6}};
  return setup;
}

std::vector<Seen> live(const std::filesystem::path& folder) {
  rtos::VirtualClock clock;
  const SimIris iris(2, {}, clock);
  const auto paint = [](std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      images[i] = GreyImage(8, 6, static_cast<std::uint8_t>(10 * i + exposures[i].noise.tick));
    }
  };
  SimFrameGrabber grabber(setup(), paint, iris, clock);
  auto recorder = FrameRecorder::open(folder, {"left", "right"});
  if (!recorder) throw std::runtime_error(recorder.error().message);
  std::vector<Seen> seen;
  for (int tick = 0; tick < kTicks; ++tick) {
    grabber.prepare(due(tick));
    seen.push_back(grab(grabber, clock, tick));
    EXPECT_TRUE((*recorder)->record(static_cast<std::uint64_t>(tick), grabber));
  }
  EXPECT_TRUE((*recorder)->finish());
  return seen;
}

TEST(FrameRecorderTest, AReplayWaitsAndSeesAsTheLiveRunDid) {
  const test::TemporaryFolder folder;
  const std::vector<Seen> was = live(folder.path());
  rtos::VirtualClock clock;
  auto grabber = drivers::RecordedFrameGrabber::open(
      folder.path(), {{"left", 8, 6}, {"right", 8, 6}}, [&](Time until) { clock.jump_to(until); });
  ASSERT_TRUE(grabber) << grabber.error().message;
  EXPECT_TRUE((*grabber)->has_times());
  for (int tick = 0; tick < kTicks; ++tick) {
    EXPECT_TRUE((*grabber)->load(static_cast<std::uint64_t>(tick)).empty());
    EXPECT_EQ(grab(**grabber, clock, tick), was[static_cast<std::size_t>(tick)]) << tick;
  }
  EXPECT_TRUE(was[3].delivered == CameraSet(0b10) && was[3].after == due(3) + milliseconds(50));
}

TEST(FrameRecorderTest, FramesOfAnOlderRecordingGoAndOtherFilesStay) {
  const test::TemporaryFolder folder;
  folder.write("left/000099.pgm", "old");
  folder.write("left/notes.pgm", "not a frame");
  live(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "left/000099.pgm"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "left/notes.pgm"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "left/000000.pgm"));
}

TEST(FrameRecorderTest, AFolderThatCannotBeMadeIsOneLine) {
  const test::TemporaryFolder folder;
  folder.write("taken", "a file");
  const auto recorder = FrameRecorder::open(folder.path() / "taken", {"left"});
  ASSERT_FALSE(recorder);
  EXPECT_NE(recorder.error().message.find("taken"), std::string::npos);
  EXPECT_EQ(recorder.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace dottrack::host_sim
