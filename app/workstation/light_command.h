#pragma once
// dottrack light: the scenarios of light, with light control and without.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

void add_light_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
