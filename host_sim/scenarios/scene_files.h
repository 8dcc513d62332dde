#pragma once
// A scene as files: what a rig, its recorder and its surveyor would have left behind.

#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// folder/rig.toml, folder/<camera>.cahvor, folder/target.csv.
Result<void> write_rig(const Scene& scene, const std::filesystem::path& folder);

// folder/<camera>/<tick, six digits>.pgm for ticks 0 to ticks - 1; later ticks that an older run
// left there are removed. threads 0: as many as the machine has.
Result<void> write_frames(const Scene& scene, std::uint64_t ticks,
                          const std::filesystem::path& folder, unsigned threads = 0);

// The vehicle's poses in TUM order, `t x y z qx qy qz qw`, one line a tick.
Result<void> write_truth(const Scene& scene, std::uint64_t ticks,
                         const std::filesystem::path& file);

}  // namespace dottrack::host_sim
