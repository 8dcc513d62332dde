#include "app/firmware/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace dottrack::firmware {
namespace {

std::string_view word_of(telemetry::Severity severity) {
  switch (severity) {
    case telemetry::Severity::error:
      return "error: ";
    case telemetry::Severity::warning:
      return "warning: ";
    case telemetry::Severity::info:
      break;
  }
  return "";
}

}  // namespace

void log_line(telemetry::Severity severity, const std::string& text) {
  static const bool kForJournal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::string line = kForJournal ? fmt::format("<{}>{}", static_cast<int>(severity), text)
                                 : fmt::format("dottrackd: {}{}", word_of(severity), text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void log_warnings(std::span<const std::string> lines) {
  for (const std::string& line : lines) log_line(telemetry::Severity::warning, line);
}

}  // namespace dottrack::firmware
