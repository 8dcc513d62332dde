#include "app/core/protocol/command.h"

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/e2e.h"
#include "app/core/protocol/frame_writer.h"

namespace dottrack::protocol {
namespace {

namespace request = layout::command;
namespace response = layout::reply;

static_assert(command_id(Addressing{.base_id = 0, .extended = false, .fd = false}) ==
              request::kMessage.offset);

bool sound(const hal::CanFrame& frame) {
  if (frame.length != request::kMessage.length) return false;
  const std::uint64_t word = to_word(frame.data.data());
  return get(request::kCRC, word) == e2e::profile2_crc(word, request::kMessage.data_id);
}

bool known(std::uint64_t code) {
  return code >= static_cast<std::uint64_t>(CommandCode::acquire) &&
         code <= static_cast<std::uint64_t>(CommandCode::report_version);
}

CommandReader::Verdict read(std::uint64_t word) {
  CommandReader::Verdict verdict;
  verdict.code = static_cast<std::uint8_t>(get(request::kCommand, word));
  if (known(verdict.code)) verdict.command.code = static_cast<CommandCode>(verdict.code);
  verdict.command.argument = static_cast<std::uint8_t>(get(request::kArgument, word));
  verdict.command.token = static_cast<std::uint16_t>(get(request::kToken, word));
  return verdict;
}

bool argument_fits(const Command& command, unsigned targets) {
  return command.code == CommandCode::set_target ? command.argument < targets
                                                 : command.argument == 0;
}

}  // namespace

std::string_view to_string(CommandResult result) {
  switch (result) {
    case CommandResult::done:
      return "done";
    case CommandResult::repeated:
      return "repeated";
    case CommandResult::unknown_command:
      return "unknown_command";
    case CommandResult::bad_argument:
      return "bad_argument";
    case CommandResult::too_soon:
      return "too_soon";
    case CommandResult::failed:
      return "failed";
  }
  return "unknown";
}

std::optional<CommandReader::Verdict> CommandReader::take(const hal::CanFrame& frame, Time now) {
  const bool ours = frame.id == command_id(addressing_) && frame.extended == addressing_.extended;
  if (!ours) return std::nullopt;
  if (!sound(frame)) {
    ++counts_.corrupted;
    return std::nullopt;
  }
  Verdict verdict = read(to_word(frame.data.data()));
  verdict.result = judge(verdict, to_word(frame.data.data()), now);
  if (verdict.result == CommandResult::done) {
    last_accepted_ = now;
  } else {
    ++counts_.rejected;
  }
  return verdict;
}

CommandResult CommandReader::judge(const Verdict& verdict, std::uint64_t word, Time now) {
  const auto sequence = static_cast<std::uint8_t>(get(request::kSequence, word));
  const bool repeated = last_sequence_ == sequence;
  last_sequence_ = sequence;
  if (repeated) return CommandResult::repeated;
  if (!known(verdict.code)) return CommandResult::unknown_command;
  const bool more = get(request::kUnused, word) != 0;
  if (more || !argument_fits(verdict.command, targets_)) return CommandResult::bad_argument;
  if (last_accepted_ && now - *last_accepted_ < kShortestPeriod) return CommandResult::too_soon;
  return CommandResult::done;
}

void CommandReader::carried_out(bool success) {
  ++(success ? counts_.accepted : counts_.rejected);
}

hal::CanFrame CommandReader::reply(const Verdict& verdict, CommandResult result) {
  const std::uint64_t word = put(response::kCommand, verdict.code) |
                             put(response::kResult, static_cast<std::uint64_t>(result)) |
                             put(response::kToken, verdict.command.token) |
                             put(response::kAccepted, counts_.accepted) |
                             put(response::kRejected, counts_.rejected + counts_.corrupted);
  hal::CanFrame frame;
  FrameWriter(addressing_, replies_++).write(response::kMessage, word, frame);
  return frame;
}

hal::CanFrame encode_command(const Command& command, const Addressing& addressing,
                             std::uint8_t sequence) {
  const std::uint64_t word = put(request::kCommand, static_cast<std::uint64_t>(command.code)) |
                             put(request::kArgument, command.argument) |
                             put(request::kToken, command.token);
  hal::CanFrame frame;
  FrameWriter(addressing, sequence).write(request::kMessage, word, frame);
  return frame;
}

}  // namespace dottrack::protocol
