#pragma once
// Lines for the journal: standard error, with the severity in front where a journal reads it.

#include <span>
#include <string>

#include "app/telemetry/unit_log.h"

namespace dottrack::firmware {

// One line; a line break within it becomes a space. Callable from any thread but the loop's.
void log_line(telemetry::Severity severity, const std::string& text);

// A warning each.
void log_warnings(std::span<const std::string> lines);

}  // namespace dottrack::firmware
