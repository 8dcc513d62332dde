// Which frames a stream of poses becomes.

#include "app/workstation/mavlink/pose_sequence.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/unit/mavlink/poses.h"

namespace dottrack::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::plain_pose;

constexpr unsigned kHeartbeat = 0;
constexpr unsigned kVision = 102;
constexpr unsigned kOdometry = 331;

unsigned number_of(const MavlinkFrame& frame) {
  return frame.bytes[7] + 256U * frame.bytes[8] + 65536U * frame.bytes[9];
}

std::vector<unsigned> numbers(PoseSequence& sequence, const dottrack_pose& pose) {
  std::vector<unsigned> found;
  for (const MavlinkFrame& frame : sequence.frames_of(pose)) found.push_back(number_of(frame));
  return found;
}

dottrack_pose at(std::uint64_t arrival_us) {
  dottrack_pose pose = plain_pose();
  pose.arrival_us = arrival_us;
  return pose;
}

// Of the odometry, which is the last frame.
std::uint8_t resets_of(PoseSequence& sequence, std::uint8_t count, bool restarted = false) {
  dottrack_pose pose = plain_pose();
  pose.reset_count = count;
  pose.restarted = restarted;
  return sequence.frames_of(pose).back().bytes[10 + 230];
}

TEST(PoseSequence, SendsAHeartbeatASecond) {
  PoseSequence sequence({});
  EXPECT_THAT(numbers(sequence, at(1'000'000)), ElementsAre(kHeartbeat, kVision, kOdometry));
  EXPECT_THAT(numbers(sequence, at(1'500'000)), ElementsAre(kVision, kOdometry));
  EXPECT_THAT(numbers(sequence, at(1'999'999)), ElementsAre(kVision, kOdometry));
  EXPECT_THAT(numbers(sequence, at(2'000'000)), ElementsAre(kHeartbeat, kVision, kOdometry));
  EXPECT_THAT(numbers(sequence, at(10)), ElementsAre(kHeartbeat, kVision, kOdometry));
}

TEST(PoseSequence, SendsNoPoseThatIsNotValid) {
  PoseSequence sequence({});
  dottrack_pose none = at(1'000'000);
  none.valid = false;
  EXPECT_THAT(numbers(sequence, none), ElementsAre(kHeartbeat));
  none.arrival_us += 1000;
  EXPECT_THAT(numbers(sequence, none), IsEmpty());
}

TEST(PoseSequence, SendsNoPoseOfUnknownAge) {
  PoseSequence sequence({});
  dottrack_pose pose = at(1'000'000);
  pose.age_us = UINT32_MAX;
  EXPECT_FALSE(can_be_handed_over(pose));
  EXPECT_THAT(numbers(sequence, pose), ElementsAre(kHeartbeat));
}

TEST(PoseSequence, SendsTheMessagesAskedFor) {
  PoseSequence odometry({.vision_position_estimate = false});
  EXPECT_THAT(numbers(odometry, at(0)), ElementsAre(kHeartbeat, kOdometry));
  PoseSequence vision({.odometry = false});
  EXPECT_THAT(numbers(vision, at(0)), ElementsAre(kHeartbeat, kVision));
}

TEST(PoseSequence, CountsEveryFrameAndSaysWhoItIs) {
  PoseSequence sequence({.system = 7, .component = 42});
  std::uint8_t expected = 0;
  for (int i = 0; i < 200; ++i) {
    for (const MavlinkFrame& frame : sequence.frames_of(at(1000U * static_cast<unsigned>(i)))) {
      EXPECT_EQ(frame.bytes[4], expected++);
      EXPECT_EQ(frame.bytes[5], 7);
      EXPECT_EQ(frame.bytes[6], 42);
    }
  }
  EXPECT_EQ(expected, static_cast<std::uint8_t>(401));
}

TEST(PoseSequence, StampsWithTheMiddleOfTheExposureOnTheReceiversClock) {
  PoseSequence sequence({});
  dottrack_pose pose = at(0x10000);
  pose.age_us = 0x100;
  pose.capture_us = 77;
  const MavlinkFrame frame = sequence.frames_of(pose).back();
  EXPECT_EQ(frame.bytes[10], 0x00);
  EXPECT_EQ(frame.bytes[11], 0xFF);
  EXPECT_EQ(frame.bytes[12], 0x00);
  pose.age_us = 0x10001;  // before the clock began
  const MavlinkFrame early = sequence.frames_of(pose).back();
  for (std::size_t i = 10; i < 18; ++i) EXPECT_EQ(early.bytes[i], 0);
}

TEST(PoseSequence, FollowsTheUnitsResets) {
  PoseSequence sequence({});
  EXPECT_EQ(resets_of(sequence, 254), 254);
  EXPECT_EQ(resets_of(sequence, 254), 254);
  EXPECT_EQ(resets_of(sequence, 255), 255);
  EXPECT_EQ(resets_of(sequence, 1), 1);  // two more, around zero
}

TEST(PoseSequence, CountsARestartThatComesBackToTheSameNumber) {
  PoseSequence sequence({});
  EXPECT_EQ(resets_of(sequence, 1), 1);
  EXPECT_EQ(resets_of(sequence, 1, true), 2);
  EXPECT_EQ(resets_of(sequence, 1), 2);
  EXPECT_EQ(resets_of(sequence, 2), 3);
}

TEST(PoseSequence, KeepsInMindARestartWithoutAPose) {
  PoseSequence sequence({});
  EXPECT_EQ(resets_of(sequence, 1), 1);
  dottrack_pose restarted = plain_pose();
  restarted.valid = false;
  restarted.restarted = true;
  restarted.reset_count = 0;
  sequence.frames_of(restarted);
  EXPECT_EQ(resets_of(sequence, 1), 3);
}

TEST(PoseSequence, MakesTheSameBytesOfTheSamePoses) {
  PoseSequence one({});
  PoseSequence other({});
  for (unsigned i = 0; i < 100; ++i) {
    const auto expected = one.frames_of(at(300'000U * i));
    const auto found = other.frames_of(at(300'000U * i));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t j = 0; j < found.size(); ++j) EXPECT_EQ(found[j].bytes, expected[j].bytes);
  }
}

}  // namespace
}  // namespace dottrack::workstation
