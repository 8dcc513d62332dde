#pragma once
// What `candump -L` prints: `(1700000000.123456) can1 301#0102030405060708`.

#include <optional>
#include <string_view>

#include "hal/can_bus.h"

namespace dottrack::board {

// A data frame with an 11-bit identifier; nothing for any other line.
std::optional<hal::CanFrame> parse_candump_line(std::string_view line);

}  // namespace dottrack::board
