#pragma once
// dottrack dbc: the layout of the messages, for the identifiers that a unit has.

#include <CLI/App.hpp>

namespace dottrack::workstation {

void add_dbc_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
