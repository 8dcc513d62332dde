#pragma once
// The loop on recorded images: DIR/<camera>/<tick, six digits>.pgm in, poses and pictures out.

#include <cstdint>
#include <filesystem>

#include "app/config/rig_file.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct ReplayOptions {
  std::filesystem::path rig;
  std::filesystem::path frames;
  std::filesystem::path out;
  int repeat = 1;        // the last set of images is shown this many times
  bool pictures = true;  // overlay pictures of the last tick
};

struct ReplaySummary {
  std::uint64_t ticks = 0;
  std::uint64_t tracking_ticks = 0;
  std::int64_t first_lock_tick = -1;  // -1: never
  std::uint64_t reacquisitions = 0;
  std::uint64_t allocations_in_loop = 0;
};

// Writes poses.tum, poses.csv, can.log, report.json and pictures/<camera>.png into options.out.
Result<ReplaySummary> replay(const ReplayOptions& options);

}  // namespace dottrack::workstation
