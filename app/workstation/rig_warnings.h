#pragma once
// What a rig's files made the loader doubt, for the person who started the program.

#include <fmt/format.h>

#include <cstdio>

#include "app/config/rig_file.h"

namespace dottrack::workstation {

inline void print_warnings(const config::RigConfig& config) {
  for (const std::string& line : config.warnings) {
    fmt::print(stderr, "dottrack: warning: {}\n", line);
  }
}

}  // namespace dottrack::workstation
