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
  EXPECT_STREQ(dottrack_light_text(6), "iris_fault");
  EXPECT_STREQ(dottrack_iris_text(2), "at_end");
}

TEST(ReceiverInterface, NumbersWithoutMeaningAreUnknown) {
  EXPECT_STREQ(dottrack_state_text(2), "unknown");
  EXPECT_STREQ(dottrack_reason_text(255), "unknown");
  EXPECT_STREQ(dottrack_degraded_text(15), "unknown");
  EXPECT_STREQ(dottrack_degraded_text(0xFFFFFFFFU), "unknown");
  EXPECT_STREQ(dottrack_health_text(8), "unknown");
  EXPECT_STREQ(dottrack_result_text(6), "unknown");
  EXPECT_STREQ(dottrack_light_text(7), "unknown");
  EXPECT_STREQ(dottrack_iris_text(4), "unknown");
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

TEST(ReceiverInterface, ReadsTheLightOfEachCamera) {
  Listener listener;
  EXPECT_FALSE(listener.light(15).known);
  const LightBits sent{
      .camera = 15, .state = 4, .iris = 2, .exposure = 10'000, .gain = 800, .opening = 100};
  EXPECT_EQ(listener.push(light_frame(sent, 7), 1234), DOTTRACK_WAITING);
  const dottrack_light& light = listener.light(15);
  EXPECT_TRUE(light.known);
  EXPECT_STREQ(dottrack_light_text(light.state), "too_dark");
  EXPECT_STREQ(dottrack_iris_text(light.iris), "at_end");
  EXPECT_DOUBLE_EQ(light.exposure_s, 0.01);
  EXPECT_DOUBLE_EQ(light.gain, 8.0);
  EXPECT_DOUBLE_EQ(light.opening, 1.0);
  EXPECT_EQ(light.arrival_us, 1234U);
  for (unsigned camera = 0; camera < 15; ++camera) EXPECT_FALSE(listener.light(camera).known);
}

TEST(ReceiverInterface, LightThatIsNotAvailableIsNegative) {
  Listener listener;
  const LightBits none{.exposure = (1U << 20U) - 1, .gain = 4095, .opening = 127};
  listener.push(light_frame(none, 0), 0);
  EXPECT_EQ(listener.light(0).exposure_s, -1.0);
  EXPECT_EQ(listener.light(0).gain, -1.0);
  EXPECT_EQ(listener.light(0).opening, -1.0);
  const LightBits most{.exposure = (1U << 20U) - 2, .gain = 4094, .opening = 101};
  listener.push(light_frame(most, 1), 0);
  EXPECT_DOUBLE_EQ(listener.light(0).exposure_s, 1.048574);
  EXPECT_DOUBLE_EQ(listener.light(0).gain, 40.94);
  EXPECT_EQ(listener.light(0).opening, -1.0) << "wider than open";
}

TEST(ReceiverInterface, DamagedLightChangesNothing) {
  Listener listener;
  const LightBits sent{.camera = 3, .state = 3, .iris = 1, .exposure = 4000, .gain = 100};
  for (unsigned bit = 0; bit < 64; ++bit) {
    dottrack_frame frame = light_frame(sent, 0);
    flip_bit(frame, bit);
    EXPECT_EQ(listener.push(frame, bit), DOTTRACK_CORRUPTED) << bit;
  }
  for (unsigned camera = 0; camera < 16; ++camera) EXPECT_FALSE(listener.light(camera).known);
}

// Light is not bound to a group: it comes between its frames, and what is lost of it loses none.
TEST(ReceiverInterface, LightBetweenTheFramesOfAGroupLeavesItWhole) {
  Unit unit;
  Listener listener;
  const Group group = unit.next();
  std::uint8_t sequence = 200;
  dottrack_verdict verdict = DOTTRACK_FOREIGN;
  for (const dottrack_frame& frame : frames_of(group)) {
    listener.push(light_frame({.state = 3}, sequence++), unit.arrival_us());
    verdict = listener.push(frame, unit.arrival_us());
  }
  EXPECT_EQ(verdict, DOTTRACK_FRESH);
  EXPECT_EQ(listener.counts().incomplete + listener.counts().lost_groups, 0U);
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
