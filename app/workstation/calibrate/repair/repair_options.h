#pragma once
// What `dottrack calibrate --repair` takes beside --rig and --out.

#include <CLI/CLI.hpp>

#include "app/workstation/calibrate/repair/repair.h"

namespace dottrack::calibrate {

// With --repair the command needs no survey: --dots and --images are not asked for, but --rig is.
// `request` must live as long as the command; its rig and out are the caller's to fill in.
void add_repair_options(CLI::App& calibrate, RepairRequest& request);

}  // namespace dottrack::calibrate
