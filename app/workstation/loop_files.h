#pragma once
// Where a run in virtual time leaves its results, and the clock it runs on: there before the
// hardware, which may need both.

#include <filesystem>
#include <memory>

#include "app/telemetry/output_file.h"
#include "drivers/candump/candump_can_bus.h"
#include "hal/base/result.h"
#include "rtos_shim/virtual_time/virtual_clock.h"

namespace dottrack::workstation {

struct LoopFiles {
  std::filesystem::path out;
  telemetry::OutputFile tum;
  telemetry::OutputFile filtered_tum;
  telemetry::OutputFile csv;
  std::unique_ptr<rtos::VirtualClock> clock;
  std::unique_ptr<drivers::CandumpCanBus> can_log;  // on that clock
};

// Makes the folder where it is absent. An error names what cannot be made or written.
Result<void> make_folder(const std::filesystem::path& folder);

// poses.tum, filtered.tum, poses.csv and can.log in `out`, which is made where it is absent.
Result<LoopFiles> open_loop_files(const std::filesystem::path& out,
                                  std::unique_ptr<rtos::VirtualClock> clock);

}  // namespace dottrack::workstation
