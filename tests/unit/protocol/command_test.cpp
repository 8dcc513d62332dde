#include "app/core/protocol/command.h"

#include <gtest/gtest.h>

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/frame_writer.h"
#include "tests/unit/protocol/dbc_reading.h"

namespace dottrack::protocol::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Addressing kAddressing{};
constexpr std::uint8_t kTargets = 3;

Time at(Duration since_start) {
  return Time(seconds(100) + since_start);
}

hal::CanFrame acquire(std::uint8_t sequence, std::uint16_t token = 0) {
  return encode_command({.code = CommandCode::acquire, .argument = 0, .token = token}, kAddressing,
                        sequence);
}
hal::CanFrame set_target(std::uint8_t target) {
  return encode_command({.code = CommandCode::set_target, .argument = target, .token = 7},
                        kAddressing, 1);
}

// Sound, but with any content.
hal::CanFrame raw_command(std::uint64_t code, std::uint64_t argument, std::uint64_t unused) {
  namespace c = layout::command;
  hal::CanFrame frame;
  FrameWriter(kAddressing, 1)
      .write(c::kMessage,
             put(c::kCommand, code) | put(c::kArgument, argument) | put(c::kUnused, unused), frame);
  return frame;
}

CommandResult verdict_on(const hal::CanFrame& frame) {
  CommandReader reader(kAddressing, kTargets);
  const auto verdict = reader.take(frame, at({}));
  if (!verdict) throw std::runtime_error("no command");
  EXPECT_EQ(reader.counts().rejected, verdict->result == CommandResult::done ? 0U : 1U);
  return verdict->result;
}

TEST(Command, GoesOutAsTheDbcSays) {
  const std::array frames{encode_command(
      {.code = CommandCode::set_target, .argument = 2, .token = 0xBEEF}, kAddressing, 77)};
  EXPECT_EQ(frames[0].id, kDefaultBaseId + 18);
  const Reading reading(frames);
  EXPECT_EQ(reading.at("Command.Command").text, "set_target");
  EXPECT_EQ(reading("Command.Argument"), 2);
  EXPECT_EQ(reading("Command.Token"), 0xBEEF);
  EXPECT_EQ(reading("Command.Sequence"), 77);
  EXPECT_EQ(reading("Command.Unused"), 0);
}

TEST(CommandReader, TakesEachCommandWithItsContent) {
  CommandReader reader(kAddressing, kTargets);
  const auto verdict = reader.take(set_target(2), at({}));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->result, CommandResult::done);
  EXPECT_EQ(verdict->command.code, CommandCode::set_target);
  EXPECT_EQ(verdict->code, 2);
  EXPECT_EQ(verdict->command.argument, 2);
  EXPECT_EQ(verdict->command.token, 7);
  EXPECT_EQ(verdict_on(acquire(0)), CommandResult::done);
  EXPECT_EQ(verdict_on(raw_command(3, 0, 0)), CommandResult::done);
}

TEST(CommandReader, LeavesOtherFramesAlone) {
  CommandReader reader(kAddressing, kTargets);
  hal::CanFrame other = acquire(1);
  other.id = kDefaultBaseId;
  EXPECT_FALSE(reader.take(other, at({})));
  hal::CanFrame extended = acquire(1);
  extended.extended = true;
  EXPECT_FALSE(reader.take(extended, at({})));
  EXPECT_EQ(reader.counts().corrupted, 0U);
}

TEST(CommandReader, ListensAtItsOwnBase) {
  const Addressing elsewhere{.base_id = 0x1ABCDE00, .extended = true, .fd = false};
  CommandReader reader(elsewhere, kTargets);
  EXPECT_FALSE(reader.take(acquire(1), at({})));
  const auto verdict = reader.take(encode_command({}, elsewhere, 1), at({}));
  ASSERT_TRUE(verdict);
  const hal::CanFrame reply = reader.reply(*verdict, CommandResult::done);
  EXPECT_EQ(reply.id, 0x1ABCDE00U + 17U);
  EXPECT_TRUE(reply.extended);
}

TEST(CommandReader, CountsEveryCorruptedFrameAndAnswersNone) {
  CommandReader reader(kAddressing, kTargets);
  std::uint64_t corrupted = 0;
  for (unsigned bit = 0; bit < 64; ++bit) {
    hal::CanFrame frame = acquire(1);
    frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_FALSE(reader.take(frame, at({}))) << bit;
    EXPECT_EQ(reader.counts().corrupted, ++corrupted);
  }
  for (const std::uint8_t length : std::array<std::uint8_t, 4>{0, 7, 9, 64}) {
    hal::CanFrame frame = acquire(1);
    frame.length = length;
    EXPECT_FALSE(reader.take(frame, at({})));
    EXPECT_EQ(reader.counts().corrupted, ++corrupted);
  }
  hal::CanFrame reply_as_command = reader.reply({}, CommandResult::done);
  reply_as_command.id = kDefaultBaseId + 18;
  EXPECT_FALSE(reader.take(reply_as_command, at({})));
  EXPECT_EQ(reader.counts().corrupted, 69U);
  EXPECT_EQ(reader.counts().accepted + reader.counts().rejected, 0U);
}

TEST(CommandReader, KnowsNoOtherCommands) {
  int unknown = 0;
  for (std::uint64_t code = 0; code < 256; ++code) {
    if (code >= 1 && code <= 3) continue;
    unknown += verdict_on(raw_command(code, 0, 0)) == CommandResult::unknown_command ? 1 : 0;
  }
  EXPECT_EQ(unknown, 253);
}

TEST(CommandReader, RefusesArgumentsThatMakeNoSense) {
  for (unsigned target = 0; target < 256; ++target) {
    EXPECT_EQ(verdict_on(set_target(static_cast<std::uint8_t>(target))),
              target < kTargets ? CommandResult::done : CommandResult::bad_argument);
  }
  EXPECT_EQ(verdict_on(raw_command(1, 1, 0)), CommandResult::bad_argument);
  EXPECT_EQ(verdict_on(raw_command(3, 255, 0)), CommandResult::bad_argument);
  EXPECT_EQ(verdict_on(raw_command(1, 0, 1)), CommandResult::bad_argument);
  EXPECT_EQ(verdict_on(raw_command(2, 0, 0x8000)), CommandResult::bad_argument);
}

TEST(CommandReader, TakesACommandOnceOnly) {
  CommandReader reader(kAddressing, kTargets);
  EXPECT_EQ(reader.take(acquire(5), at({}))->result, CommandResult::done);
  EXPECT_EQ(reader.take(acquire(5), at(seconds(10)))->result, CommandResult::repeated);
  EXPECT_EQ(reader.take(acquire(5 + 16), at(seconds(20)))->result, CommandResult::done);
  EXPECT_EQ(reader.take(acquire(5), at(seconds(30)))->result, CommandResult::done);
  EXPECT_EQ(reader.counts().rejected, 1U);
}

TEST(CommandReader, ARefusedCommandHasItsSequenceTakenToo) {
  CommandReader reader(kAddressing, kTargets);
  EXPECT_EQ(reader.take(set_target(200), at({}))->result, CommandResult::bad_argument);
  EXPECT_EQ(reader.take(acquire(1), at({}))->result, CommandResult::repeated);
}

TEST(CommandReader, TakesOneCommandASecond) {
  CommandReader reader(kAddressing, kTargets);
  EXPECT_EQ(reader.take(acquire(1), at({}))->result, CommandResult::done);
  EXPECT_EQ(reader.take(acquire(2), at({}))->result, CommandResult::too_soon);
  EXPECT_EQ(reader.take(acquire(3), at(milliseconds(999)))->result, CommandResult::too_soon);
  // What was refused does not put off what comes next.
  EXPECT_EQ(reader.take(acquire(4), at(seconds(1)))->result, CommandResult::done);
  EXPECT_EQ(reader.take(acquire(5), at(milliseconds(1999)))->result, CommandResult::too_soon);
  EXPECT_EQ(reader.counts().rejected, 3U);
}

TEST(CommandReader, RefusedCommandsAreNotLimited) {
  CommandReader reader(kAddressing, kTargets);
  EXPECT_EQ(reader.take(set_target(99), at({}))->result, CommandResult::bad_argument);
  EXPECT_EQ(reader.take(acquire(2), at(milliseconds(1)))->result, CommandResult::done);
}

TEST(CommandReader, CountsWhatBecameOfCommands) {
  CommandReader reader(kAddressing, kTargets);
  reader.take(acquire(1), at({}));
  reader.carried_out(true);
  reader.take(acquire(2), at(seconds(1)));
  reader.carried_out(false);
  reader.take(acquire(2), at(seconds(2)));
  EXPECT_EQ(reader.counts().accepted, 1U);
  EXPECT_EQ(reader.counts().rejected, 2U);
}

TEST(CommandReader, RepliesWithWhatBecameOfItAndTheCounts) {
  CommandReader reader(kAddressing, kTargets);
  const auto verdict = reader.take(acquire(1, 0xCAFE), at({}));
  ASSERT_TRUE(verdict);
  reader.carried_out(true);
  hal::CanFrame broken = acquire(2);
  broken.data[0] ^= 1U;
  reader.take(broken, at({}));
  reader.take(acquire(1), at({}));
  const std::array frames{reader.reply(*verdict, CommandResult::failed)};
  const Reading reading(frames);
  EXPECT_EQ(frames[0].id, kDefaultBaseId + 17);
  EXPECT_EQ(reading.at("Reply.Command").text, "acquire");
  EXPECT_EQ(reading.at("Reply.Result").text, "failed");
  EXPECT_EQ(reading("Reply.Token"), 0xCAFE);
  EXPECT_EQ(reading("Reply.Accepted"), 1);
  EXPECT_EQ(reading("Reply.Rejected"), 2);
  EXPECT_EQ(reading("Reply.Sequence"), 0);
  EXPECT_EQ(reader.reply(*verdict, CommandResult::done).data[1], 1);
}

TEST(CommandReader, RepliesToAnUnknownCommandByItsNumber) {
  CommandReader reader(kAddressing, kTargets);
  const auto verdict = reader.take(raw_command(200, 0, 0), at({}));
  ASSERT_TRUE(verdict);
  const std::array frames{reader.reply(*verdict, verdict->result)};
  EXPECT_EQ(Reading(frames)("Reply.Command"), 200);
  EXPECT_EQ(Reading(frames).at("Reply.Result").text, "unknown_command");
}

}  // namespace
}  // namespace dottrack::protocol::test
