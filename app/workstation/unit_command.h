#pragma once
// dottrack command INTERFACE acquire|set-target|report-version: a command to the unit over CAN.

#include <CLI/App.hpp>

namespace dottrack::workstation {

// exit_status: 0 the unit has done it; 1 it refused or did not answer; 2 wrong use, no such
// interface.
void add_unit_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
