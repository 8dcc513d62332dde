#pragma once
// --base-id and --extended, which several commands share.

#include <CLI/App.hpp>
#include <string>

#include "app/core/protocol/addressing.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

// `addressing` outlives the command.
void add_addressing_options(CLI::App& command, protocol::Addressing& addressing);

// An error names the option and the range.
Result<void> check_addressing(const protocol::Addressing& addressing);

}  // namespace dottrack::workstation
