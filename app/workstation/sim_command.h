#pragma once
// `dottrack sim`: the loop against the simulated world.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

// Sets exit_status when the command has run.
void add_sim_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
