#pragma once
// What a run of the loop comes to, for whoever started it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/core/tick_result.h"

namespace dottrack::workstation {

struct RunSummary {
  std::uint64_t ticks = 0;
  std::uint64_t tracking_ticks = 0;   // with a pose
  std::int64_t first_lock_tick = -1;  // -1: never
  std::uint64_t reacquisitions = 0;
  std::uint64_t allocations_in_loop = 0;  // heap calls of any kind during ticks
  std::uint64_t bad_frames = 0;           // images that were there and could not be read
  double mean_rms_residual_m = 0.0;
  std::optional<core::TickResult> last_lock;  // the last tick with a pose
  std::size_t tracker_bytes = 0;
  std::string output_fault;  // one line when the results could not be written, else empty
};

}  // namespace dottrack::workstation
