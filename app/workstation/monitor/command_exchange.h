#pragma once
// A command to the unit and its answer.

#include <cstdint>
#include <optional>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/base/result.h"
#include "hal/can_bus.h"
#include "rtos_shim/clock.h"

namespace dottrack::monitor {

struct CommandRequest {
  dottrack_command command = DOTTRACK_COMMAND_REPORT_VERSION;
  std::uint8_t argument = 0;
  std::uint16_t token = 0;    // of the first try
  std::uint8_t sequence = 0;  // of the first try
  Duration patience = std::chrono::seconds(2);
};

struct CommandAnswer {
  std::optional<dottrack_reply> reply;  // nothing: none came in time
  dottrack_unit unit{};                 // what the unit told of itself meanwhile
};

// Sends the command and waits for the reply with its token; after report_version for version and
// configuration too. Should the unit have got the same sequence before, the next one is tried.
// An error: the bus does not take the command.
Result<CommandAnswer> exchange(hal::CanBus& bus, const rtos::Clock& clock,
                               const dottrack_settings& settings, const CommandRequest& request);

}  // namespace dottrack::monitor
