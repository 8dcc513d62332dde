// Which frames make a group, and in which order they go out.

#include <gtest/gtest.h>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

std::vector<std::uint32_t> offsets(const GroupFrames& frames, std::uint32_t base_id) {
  std::vector<std::uint32_t> all;
  for (const hal::CanFrame& frame : frames) all.push_back(frame.id - base_id);
  return all;
}

PoseMessage message_of(std::uint8_t dots) {
  std::mt19937_64 random(1);
  PoseMessage message = random_message(random);
  message.dots_known = dots;
  return message;
}

using Offsets = std::vector<std::uint32_t>;

TEST(Group, WithNothingMoreIsSixMessagesOrOne) {
  EXPECT_EQ(offsets(encoded(message_of(4), classic(), {}), 0x300), (Offsets{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(offsets(encoded(message_of(4), fd(), {}), 0x300), (Offsets{16}));
}

TEST(Group, HasItsPartsInTheOrderOfTheProtocol) {
  EXPECT_EQ(offsets(encoded(message_of(2), classic()), 0x300),
            (Offsets{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 32, 33, 34, 35}));
  EXPECT_EQ(offsets(encoded(message_of(2), fd()), 0x300), (Offsets{16, 6, 7, 13, 32, 33, 34, 35}));
}

TEST(Group, AnnouncesWhatItHas) {
  for (unsigned bits = 0; bits < 16; ++bits) {
    const GroupParts parts{.covariance = (bits & 1U) != 0,
                           .motion = (bits & 2U) != 0,
                           .cameras = (bits & 4U) != 0,
                           .dots = (bits & 8U) != 0};
    const GroupFrames frames = encoded(message_of(5), classic(), parts);
    const Reading reading(frames);
    EXPECT_EQ(reading("Quality.CovarianceFollows"), parts.covariance ? 1 : 0);
    EXPECT_EQ(reading("Quality.MotionFollows"), parts.motion ? 1 : 0);
    EXPECT_EQ(reading("Quality.CamerasFollow"), parts.cameras ? 1 : 0);
    EXPECT_EQ(reading("Quality.DotsFollow"), parts.dots ? 5 : 0);
    EXPECT_EQ(frames.size(), 6U + (parts.covariance ? 5 : 0) + (parts.motion ? 2 : 0) +
                                 (parts.cameras ? 1 : 0) + (parts.dots ? 10 : 0));
    const GroupFrames long_frames = encoded(message_of(5), fd(), parts);
    const Reading of_fd(long_frames);
    EXPECT_EQ(of_fd("FdPose.CovarianceFollows"), 1);  // it is there in any case
    EXPECT_EQ(of_fd("FdPose.MotionFollows"), parts.motion ? 1 : 0);
    EXPECT_EQ(of_fd("FdPose.CamerasFollow"), parts.cameras ? 1 : 0);
    EXPECT_EQ(of_fd("FdPose.DotsFollow"), parts.dots ? 5 : 0);
    EXPECT_EQ(long_frames.size(),
              1U + (parts.motion ? 2 : 0) + (parts.cameras ? 1 : 0) + (parts.dots ? 10 : 0));
  }
}

TEST(Group, HoldsSixteenDotsAndNoMore) {
  EXPECT_EQ(encoded(message_of(16), classic()).size(), kMaxGroupFrames);
  EXPECT_EQ(encoded(message_of(200), classic()).size(), kMaxGroupFrames);
  EXPECT_EQ(Reading(encoded(message_of(200), fd()))("FdPose.DotsFollow"), 16);
}

TEST(Group, OnlyTheLongFrameIsFd) {
  for (const Addressing& addressing : {classic(), fd()}) {
    int long_ones = 0;
    for (const hal::CanFrame& frame : encoded(message_of(16), addressing)) {
      const bool is_long = frame.id == 0x310;
      long_ones += is_long ? 1 : 0;
      EXPECT_EQ(frame.fd, is_long);
      EXPECT_EQ(frame.bit_rate_switch, is_long);
      EXPECT_EQ(frame.length, is_long ? 64 : 8);
      EXPECT_FALSE(frame.extended);
    }
    EXPECT_EQ(long_ones, addressing.fd ? 1 : 0);
  }
}

TEST(Group, AnotherBaseShiftsTheIdentifiersAndNothingElse) {
  const GroupFrames at_default = encoded(message_of(16), classic());
  for (const Addressing& addressing :
       {Addressing{.base_id = kLastBaseId, .extended = false, .fd = false},
        Addressing{.base_id = kLastExtendedBaseId, .extended = true, .fd = false}}) {
    const GroupFrames frames = encoded(message_of(16), addressing);
    ASSERT_EQ(frames.size(), at_default.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].id - addressing.base_id, at_default[i].id - kDefaultBaseId);
      EXPECT_EQ(frames[i].extended, addressing.extended);
      EXPECT_EQ(frames[i].data, at_default[i].data);
    }
  }
}

TEST(Group, ReplacesTheFramesThatWereThere) {
  GroupFrames frames = encoded(message_of(16), classic());
  encode_group(message_of(16), {}, fd(), 7, frames);
  EXPECT_EQ(frames.size(), 1U);
}

TEST(Group, IsTheSameBytesForTheSameMessage) {
  const GroupFrames one = encoded(message_of(16), classic());
  const GroupFrames other = encoded(message_of(16), classic());
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].data, other[i].data);
}

TEST(Identity, SaysWhatTheUnitIs) {
  const IdentityMessage message{.major = 1,
                                .minor = 2,
                                .patch = 3,
                                .group_period = std::chrono::microseconds(33333),
                                .config_hash = 0xDEADBEEF,
                                .target = 2,
                                .cameras = 12};
  const IdentityFrames frames = encode_identity(message, classic(), 9);
  EXPECT_EQ(frames[0].id, 0x30EU);
  EXPECT_EQ(frames[1].id, 0x30FU);
  const Reading reading(frames);
  EXPECT_EQ(reading("Version.Protocol"), 2);
  EXPECT_EQ(reading("Version.Major"), 1);
  EXPECT_EQ(reading("Version.Minor"), 2);
  EXPECT_EQ(reading("Version.Patch"), 3);
  EXPECT_EQ(reading.raw("Version.GroupPeriod"), 333);
  EXPECT_EQ(reading("Version.Sequence"), 9);
  EXPECT_EQ(reading.raw("Configuration.ConfigHash"), 0xDEADBEEF);
  EXPECT_EQ(reading("Configuration.Target"), 2);
  EXPECT_EQ(reading("Configuration.Cameras"), 12);
}

TEST(Identity, TheGroupPeriodSaturates) {
  IdentityMessage message;
  const auto sent = [&message](Duration period) {
    message.group_period = period;
    return Reading(encode_identity(message, classic(), 0)).raw("Version.GroupPeriod");
  };
  EXPECT_EQ(sent(Duration(0)), 0);
  EXPECT_EQ(sent(Duration(-1)), 0);
  EXPECT_EQ(sent(std::chrono::microseconds(150)), 2);
  EXPECT_EQ(sent(std::chrono::microseconds(6553500)), 65535);
  EXPECT_EQ(sent(Duration::max()), 65535);
}

}  // namespace
}  // namespace dottrack::protocol::test
