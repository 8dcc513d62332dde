#pragma once
// `dottrack experiments`: the paper's experiments (section 4) in the simulated sandbox.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

// Sets exit_status when the command has run.
void add_experiments_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
