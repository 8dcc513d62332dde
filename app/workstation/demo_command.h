#pragma once
// dottrack demo --out DIR [--seed N] [--ticks N]: renders a small synthetic scene to files, replays
// them as if cameras had recorded them, and tells how far the poses are from the truth.

#include <CLI/CLI.hpp>

namespace dottrack::workstation {

// The callback runs the command and sets exit_status: 0 done; 1 no lock, a wrong lock or results
// that cannot be written; 2 wrong use.
void add_demo_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
