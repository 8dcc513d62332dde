#pragma once
// `dottrack consistency`: whether covariances are true, in many simulated halls.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

// Sets exit_status when the command has run.
void add_consistency_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
