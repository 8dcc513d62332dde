// Commands, replies, words, and the header seen from C.

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/from_c.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

TEST(ReceiverInterface, WorksFromC) {
  EXPECT_EQ(frames_a_c_program_finds_foreign(), 3);
}

TEST(ReceiverInterface, TheBuilderHasTheChecksumsOfTheStandard) {
  EXPECT_EQ(profile2_crc({0x01, 0x02, 0x03, 0x12}), 0x5F);
  EXPECT_EQ(profile2_crc({0x01, 0x02, 0x03, 0xFF}), 0xED);
  EXPECT_EQ(profile2_crc({0x01, 0x23, 0x45, 0x67, 0x89, 0xA5}), 0x1A);
  EXPECT_EQ(profile2_crc({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xDF);
  EXPECT_EQ(profile5_crc({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0x29B1);
}

TEST(ReceiverInterface, MakesCommands) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = DOTTRACK_DEFAULT_BASE_ID;
  const dottrack_frame frame =
      dottrack_command_frame(&settings, DOTTRACK_COMMAND_SET_TARGET, 3, 0xBEEF, 200);
  dottrack_frame expected{};
  expected.id = DOTTRACK_DEFAULT_BASE_ID + kCommand;
  expected.length = 8;
  put_bits(expected, 8, 8, 200);
  put_bits(expected, 16, 8, 2);
  put_bits(expected, 24, 8, 3);
  put_bits(expected, 32, 16, 0xBEEF);
  seal(expected);
  EXPECT_EQ(frame.id, expected.id);
  EXPECT_FALSE(frame.extended);
  EXPECT_EQ(frame.length, 8);
  EXPECT_EQ(std::to_array(frame.data), std::to_array(expected.data));
}

TEST(ReceiverInterface, MakesCommandsForExtendedIdentifiers) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = 0x1ABCDE00;
  settings.extended = true;
  const dottrack_frame frame = dottrack_command_frame(&settings, DOTTRACK_COMMAND_ACQUIRE, 0, 1, 0);
  EXPECT_EQ(frame.id, 0x1ABCDE00U + kCommand);
  EXPECT_TRUE(frame.extended);
}

TEST(ReceiverInterface, ReadsReplies) {
  const dottrack_settings settings = dottrack_default_settings();
  const dottrack_reply sent{
      .command = 2, .result = 3, .token = 0xA55A, .accepted = 7, .rejected = 255};
  dottrack_frame frame = reply_frame(sent, 9);
  dottrack_reply read{};
  ASSERT_TRUE(dottrack_read_reply(&settings, &frame, &read));
  EXPECT_EQ(read.command, sent.command);
  EXPECT_EQ(read.result, sent.result);
  EXPECT_EQ(read.token, sent.token);
  EXPECT_EQ(read.accepted, sent.accepted);
  EXPECT_EQ(read.rejected, sent.rejected);
  EXPECT_EQ(Listener().push(frame, 0), DOTTRACK_WAITING);
}

TEST(ReceiverInterface, RefusesWhatIsNoSoundReply) {
  const dottrack_settings settings = dottrack_default_settings();
  const dottrack_frame sound = reply_frame({}, 0);
  dottrack_reply reply{};
  unsigned refused = 0;
  for (unsigned bit = 0; bit < 64; ++bit) {
    dottrack_frame frame = sound;
    flip_bit(frame, bit);
    refused += dottrack_read_reply(&settings, &frame, &reply) ? 0U : 1U;
  }
  EXPECT_EQ(refused, 64U);
  dottrack_frame elsewhere = sound;
  elsewhere.id += 64;
  EXPECT_FALSE(dottrack_read_reply(&settings, &elsewhere, &reply));
  dottrack_frame extended = sound;
  extended.extended = true;
  EXPECT_FALSE(dottrack_read_reply(&settings, &extended, &reply));
  dottrack_frame longer = sound;
  longer.length = 255;
  EXPECT_FALSE(dottrack_read_reply(&settings, &longer, &reply));
}

TEST(ReceiverInterface, EveryNumberHasAWord) {
  std::set<std::string> verdicts;
  for (unsigned i = 0; i < 8; ++i) {
    verdicts.insert(dottrack_verdict_text(static_cast<dottrack_verdict>(i)));
  }
  EXPECT_EQ(verdicts.size(), 8U);
  EXPECT_EQ(verdicts.count("unknown"), 0U);
  EXPECT_STREQ(dottrack_state_text(DOTTRACK_TRACKING), "tracking");
  EXPECT_STREQ(dottrack_reason_text(14), "stopped");
  EXPECT_STREQ(dottrack_degraded_text(14), "rig_disagrees");
  EXPECT_STREQ(dottrack_kind_text(3), "coasting");
  EXPECT_STREQ(dottrack_kind_text(4), "unknown");
  EXPECT_STREQ(dottrack_health_text(7), "moved");
  EXPECT_STREQ(dottrack_result_text(5), "failed");
}

TEST(ReceiverInterface, NumbersWithoutMeaningAreUnknown) {
  EXPECT_STREQ(dottrack_state_text(2), "unknown");
  EXPECT_STREQ(dottrack_reason_text(255), "unknown");
  EXPECT_STREQ(dottrack_degraded_text(15), "unknown");
  EXPECT_STREQ(dottrack_degraded_text(0xFFFFFFFFU), "unknown");
  EXPECT_STREQ(dottrack_health_text(8), "unknown");
  EXPECT_STREQ(dottrack_result_text(6), "unknown");
}

TEST(ReceiverInterface, ReadsWhatTheUnitIs) {
  Listener listener;
  EXPECT_EQ(listener.push(version_frame(3, 2, {1, 20, 255}, 333), 0), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(configuration_frame(3, 0xDEADBEEF, 1, 16), 0), DOTTRACK_WAITING);
  const dottrack_unit& unit = listener.unit();
  EXPECT_TRUE(unit.has_version);
  EXPECT_EQ(unit.protocol, 2);
  EXPECT_EQ(unit.major, 1);
  EXPECT_EQ(unit.minor, 20);
  EXPECT_EQ(unit.patch, 255);
  EXPECT_EQ(unit.group_period_us, 33300U);
  EXPECT_TRUE(unit.has_configuration);
  EXPECT_EQ(unit.config_hash, 0xDEADBEEFU);
  EXPECT_EQ(unit.target, 1);
  EXPECT_EQ(unit.cameras, 16);
}

TEST(ReceiverInterface, OfAnotherVersionOnlyTheNumberIsRead) {
  Listener listener;
  EXPECT_EQ(listener.push(version_frame(3, 3, {9, 9, 9}, 333), 0), DOTTRACK_OTHER_VERSION);
  EXPECT_FALSE(listener.unit().has_version);
  EXPECT_EQ(listener.unit().protocol, 3);
  EXPECT_EQ(listener.unit().major, 0);
  EXPECT_EQ(listener.counts().other_version, 1U);
}

}  // namespace
}  // namespace dottrack::receiver_test
