#pragma once
// What `candump -L` prints: `(1700000000.123456) can1 301#0102030405060708`.

#include <optional>
#include <string_view>

#include "drivers/candump/candump_line.h"

namespace dottrack::board {

// A data frame; nothing for any other line.
inline std::optional<hal::CanFrame> parse_candump_line(std::string_view line) {
  const auto logged = drivers::parse_candump_line(line);
  return logged ? std::optional(logged->frame) : std::nullopt;
}

}  // namespace dottrack::board
