#pragma once
// dottrack target check FILE, dottrack target design N --panel SIZE: how good a target is, and a
// good one to print.

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "app/workstation/target/target_design.h"

namespace dottrack::workstation {

// "1.2x0.8" in metres, both above 0 and up to 100.
std::optional<Panel> parse_panel(const std::string& text);

// exit_status: 1 where the target is ambiguous or badly conditioned, 2 where a file or an option is
// wrong.
void add_target_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
