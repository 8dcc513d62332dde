#pragma once
// dottrack busload RIG: how much of the CAN bus a rig's messages take at worst. dottrack busload
// --table: the same for the usual bit rates, as docs/can.md has it.

#include <CLI/App.hpp>
#include <string>

#include "app/config/can_load.h"

namespace dottrack::workstation {

// A line for each kind of message, then config::describe().
std::string load_text(const config::CanUse& use);

// A Markdown table: default rates of messages, by bit rate, identifiers, frame rate and dots.
std::string load_table();

// exit_status: 2 where the rig is wrong or its messages overload the bus.
void add_busload_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
