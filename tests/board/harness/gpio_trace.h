#pragma once
// The kernel's own record of every value that is written to a GPIO line (tracepoint
// gpio:gpio_value).

#include <optional>
#include <string_view>

#include "hal/base/time.h"

namespace dottrack::board {

struct GpioWrite {
  Time at{};          // on the guest's monotonic clock
  unsigned gpio = 0;  // global number: the chip's base and the line's offset
  bool high = false;
};

// `  name-260  [001] .....    40.343326: gpio_value: 453 set 1`; nothing for reads and other lines.
std::optional<GpioWrite> parse_gpio_write(std::string_view line);

// `... tracing_mark_write: gpio-base 448`: what the guest says of the chip's first line.
std::optional<unsigned> parse_gpio_base(std::string_view line);

// `CPU:1 [LOST 12 EVENTS]`: the trace is not complete.
bool tells_of_lost_events(std::string_view line);

}  // namespace dottrack::board
