#pragma once
// What is wrong, for whoever typed the command.

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "app/workstation/exit_status.h"

namespace dottrack::workstation {

// One line on standard error; returns the status to end with.
inline int complain(const std::string& line, int status = kWrongUse) {
  fmt::print(stderr, "dottrack: {}\n", line);
  return status;
}

}  // namespace dottrack::workstation
