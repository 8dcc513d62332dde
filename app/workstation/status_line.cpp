#include "app/workstation/status_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace dottrack::workstation {
namespace {

constexpr const char* kClear = "\r\x1b[K";

}  // namespace

StatusLine::StatusLine() : on_terminal_(isatty(STDERR_FILENO) != 0) {}

bool StatusLine::show(const std::string& what) const {
  if (on_terminal_) fmt::print(stderr, "{}{}", kClear, what);
  return !Interrupt::wanted();
}

void StatusLine::clear() const {
  if (on_terminal_) fmt::print(stderr, "{}", kClear);
}

}  // namespace dottrack::workstation
