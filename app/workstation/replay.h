#pragma once
// The loop on recorded images: DIR/<camera>/<tick, six digits>.pgm in, poses and pictures out.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/config/rig_file.h"
#include "app/core/tick_result.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct ReplayOptions {
  std::filesystem::path rig;
  std::filesystem::path frames;
  std::filesystem::path out;
  int repeat = 1;        // the last set of images is shown this many times
  bool pictures = true;  // overlay pictures of the first lock and of the last tick
};

struct ReplaySummary {
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

// Writes poses.tum, poses.csv, can.log, report.json and pictures/ into options.out. The same images
// give the same bytes, but for report.json, which tells how long things took. An error is wrong
// input: nothing was replayed. An image that cannot be read is one line on standard error and a
// camera that does not deliver.
Result<ReplaySummary> replay(const ReplayOptions& options);

}  // namespace dottrack::workstation
