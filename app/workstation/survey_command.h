#pragma once
// `dottrack survey`: a target's dots learned from recorded runs.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

// Sets exit_status when the command has run.
void add_survey_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
