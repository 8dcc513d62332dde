#pragma once
// Commands over CAN, and what became of them.

#include <cstdint>
#include <optional>
#include <string_view>

#include "app/core/protocol/addressing.h"
#include "hal/base/can_frame.h"
#include "hal/base/time.h"

namespace dottrack::protocol {

enum class CommandCode : std::uint8_t { acquire = 1, set_target = 2, report_version = 3 };

struct Command {
  CommandCode code = CommandCode::acquire;
  std::uint8_t argument = 0;  // set_target: which of the rig's targets, from 0
  std::uint16_t token = 0;    // the reply repeats it
};

enum class CommandResult : std::uint8_t {
  done = 0,
  repeated = 1,  // the sequence of the command before
  unknown_command = 2,
  bad_argument = 3,
  too_soon = 4,  // within a second of the command before
  failed = 5,    // understood, but could not be carried out
};

std::string_view to_string(CommandResult result);

struct CommandCounts {
  std::uint64_t accepted = 0;   // carried out
  std::uint64_t rejected = 0;   // with a reply that says why
  std::uint64_t corrupted = 0;  // checksum or length: no reply, for it is not known to whom
};

// The judge of what arrives. Needs no memory but its own; decides by the frame and the time alone.
class CommandReader {
 public:
  static constexpr Duration kShortestPeriod = std::chrono::seconds(1);

  CommandReader(const Addressing& addressing, std::uint8_t targets)
      : addressing_(addressing), targets_(targets) {}

  struct Verdict {
    Command command;
    std::uint8_t code = 0;                       // as received: perhaps none of CommandCode
    CommandResult result = CommandResult::done;  // done: to be carried out
  };

  // Nothing for a frame that is no command of ours or is corrupted.
  std::optional<Verdict> take(const hal::CanFrame& frame, Time now);
  // After a verdict `done`: whether it could be carried out.
  void carried_out(bool success);

  const CommandCounts& counts() const { return counts_; }
  // The reply to a verdict, with the counts as they are now.
  hal::CanFrame reply(const Verdict& verdict, CommandResult result);

 private:
  CommandResult judge(const Verdict& verdict, std::uint64_t word, Time now);

  Addressing addressing_;
  std::uint8_t targets_;
  std::optional<std::uint8_t> last_sequence_;
  std::optional<Time> last_accepted_;
  std::uint8_t replies_ = 0;
  CommandCounts counts_;
};

// Of the frames that a unit listens for.
constexpr std::uint32_t command_id(const Addressing& addressing) {
  return addressing.base_id + 18;
}

// The command frame as a vehicle sends it.
hal::CanFrame encode_command(const Command& command, const Addressing& addressing,
                             std::uint8_t sequence);

}  // namespace dottrack::protocol
