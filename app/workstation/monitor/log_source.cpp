#include "app/workstation/monitor/log_source.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "drivers/candump/candump_line.h"

namespace dottrack::monitor {

LogSource::LogSource(std::istream& log, std::string interface)
    : log_(log), interface_(std::move(interface)) {}

FrameSource::Got LogSource::do_next(Arrival& arrival) {
  while (std::getline(log_, line_)) {
    if (take(line_, arrival)) return Got::frame;
  }
  return Got::end;
}

bool LogSource::take(const std::string& line, Arrival& arrival) {
  const bool blank = line.find_first_not_of(" \t\r") == std::string::npos;
  if (blank) return false;
  const std::optional<drivers::LoggedFrame> logged = drivers::parse_candump_line(line);
  if (!logged) {
    if (!drivers::is_remote_or_error_line(line)) ++unreadable_lines_;
    return false;
  }
  ++frames_;
  if (interface_.empty()) interface_ = logged->interface;
  if (logged->interface != interface_) return false;
  latest_ = std::max(latest_, logged->time);
  arrival.time = latest_;
  arrival.frame = logged->frame;
  return true;
}

}  // namespace dottrack::monitor
