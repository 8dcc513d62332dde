#pragma once
// dottrack monitor INTERFACE, dottrack monitor --log FILE: what the unit tells on the bus, judged
// as a vehicle judges it.

#include <CLI/App.hpp>

#include "app/workstation/monitor/statistics.h"

namespace dottrack::workstation {

// 0: fresh valid poses came; if strict, nothing was lost, damaged, repeated or late either. Else 1.
int monitor_exit_status(const monitor::Statistics& statistics, const dottrack_counts& counts,
                        bool strict);

// exit_status: as above; 1 too where a file cannot be written; 2 where the interface, the log or
// an option is wrong.
void add_monitor_command(CLI::App& app, int& exit_status);

}  // namespace dottrack::workstation
