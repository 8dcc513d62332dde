// Framing against the published check value, frames of others and the format's own rules.

#include "app/workstation/mavlink/mavlink_frame.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "app/workstation/mavlink/vision_messages.h"

namespace dottrack::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

std::vector<std::uint8_t> bytes_of(const MavlinkFrame& frame) {
  return {frame.view().begin(), frame.view().end()};
}

MavlinkMessage message_of(std::uint32_t id, std::initializer_list<std::uint8_t> payload) {
  MavlinkMessage message{.id = id, .crc_extra = 50, .length = payload.size(), .payload = {}};
  std::ranges::copy(payload, message.payload.begin());
  return message;
}

TEST(X25Checksum, GivesThePublishedCheckValue) {
  constexpr std::string_view kDigits = "123456789";
  const std::vector<std::uint8_t> digits(kDigits.begin(), kDigits.end());
  EXPECT_EQ(x25_checksum(digits), 0x6F91);
  EXPECT_EQ(x25_checksum({}), 0xFFFF);
}

TEST(X25Checksum, GoesOnWhereItStopped) {
  const std::vector<std::uint8_t> head{1, 2, 3};
  const std::vector<std::uint8_t> tail{4, 5};
  EXPECT_EQ(x25_checksum(tail, x25_checksum(head)),
            x25_checksum(std::vector<std::uint8_t>{1, 2, 3, 4, 5}));
}

// A heartbeat that an autopilot sent.
TEST(MavlinkFrame, EqualsOneOfAnAutopilot) {
  const MavlinkMessage message = message_of(0, {0, 0, 0, 0, 2, 3, 0x51, 3, 3});
  EXPECT_THAT(
      bytes_of(framed(message, {.sequence = 0xEF, .system = 1, .component = 1})),
      ElementsAre(0xFD, 9, 0, 0, 0xEF, 1, 1, 0, 0, 0, 0, 0, 0, 0, 2, 3, 0x51, 3, 3, 0x73, 0x89));
}

TEST(MavlinkFrame, HasTheNumberInThreeBytes) {
  const MavlinkFrame frame = framed(message_of(0x030201, {7}), {});
  EXPECT_EQ(frame.bytes[7], 1);
  EXPECT_EQ(frame.bytes[8], 2);
  EXPECT_EQ(frame.bytes[9], 3);
}

TEST(MavlinkFrame, LeavesZerosOutAtTheEndButForTheFirstByte) {
  EXPECT_EQ(framed(message_of(1, {1, 0, 2, 0, 0}), {}).length, 12U + 3U);
  EXPECT_EQ(framed(message_of(1, {0, 0, 0}), {}).length, 12U + 1U);
  EXPECT_EQ(framed(message_of(1, {0, 0, 1}), {}).length, 12U + 3U);
}

TEST(MavlinkFrame, TakesTheLongestPayload) {
  MavlinkMessage message{.id = 1, .crc_extra = 0, .length = kMaxMavlinkPayload, .payload = {}};
  message.payload.fill(0xA5);
  const MavlinkFrame frame = framed(message, {});
  EXPECT_EQ(frame.length, kMaxMavlinkFrame);
  EXPECT_EQ(frame.bytes[1], 255);
  EXPECT_EQ(frame.bytes[264], 0xA5);
}

TEST(MavlinkFrame, ChecksumsTheLayoutToo) {
  MavlinkMessage message = message_of(1, {1, 2, 3});
  const std::vector<std::uint8_t> before = bytes_of(framed(message, {}));
  message.crc_extra = 51;
  const std::vector<std::uint8_t> after = bytes_of(framed(message, {}));
  ASSERT_EQ(before.size(), after.size());
  EXPECT_TRUE(std::equal(before.begin(), before.end() - 2, after.begin()));
  EXPECT_FALSE(std::equal(before.end() - 2, before.end(), after.end() - 2));
}

TEST(Heartbeat, SaysWhatItIs) {
  const MavlinkMessage message = heartbeat();
  EXPECT_EQ(message.id, 0U);
  EXPECT_EQ(message.crc_extra, 50);
  const std::vector<std::uint8_t> payload(message.payload.begin(), message.payload.begin() + 9);
  EXPECT_EQ(message.length, 9U);
  EXPECT_THAT(payload, ElementsAreArray({0, 0, 0, 0, 18, 8, 0, 4, 3}));
}

}  // namespace
}  // namespace dottrack::workstation
