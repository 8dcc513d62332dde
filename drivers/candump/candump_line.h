#pragma once
// A line of candump, read back.

#include <optional>
#include <string>
#include <string_view>

#include "hal/base/can_frame.h"
#include "hal/base/time.h"

namespace dottrack::drivers {

struct LoggedFrame {
  Duration time{};  // as the log has it; candump -ta and -L: since 1970
  std::string interface;
  hal::CanFrame frame;
};

// Both formats: that of the log (-L, -l),
//   (1700000000.123456) can0 300#0011223344556677
//   (1700000000.123456) can0 00000310##1001122
// with 8 digits for an identifier of 29 bits and ## and the flags before the data of an FD frame;
// and that of the screen with times (-ta, with or without -x and -a),
//   (1700000000.123456)  can0  300   [8]  00 11 22 33 44 55 66 77
// in which an FD frame has two digits for its length. Nothing for whatever is no data frame.
std::optional<LoggedFrame> parse_candump_line(std::string_view line);

// A frame, but none that carries data: a remote request or what the controller says about errors.
bool is_remote_or_error_line(std::string_view line);

}  // namespace dottrack::drivers
