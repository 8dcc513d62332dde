#pragma once
// A scene as files: what a rig, its recorder and its surveyor would have left behind.

#include <filesystem>
#include <span>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// folder/rig.toml, folder/<camera>.<kind of model>, folder/target.csv. `models`: what is told of
// the cameras, in the scene's order; empty: the truth.
Result<void> write_rig(const Scene& scene, const std::filesystem::path& folder,
                       std::span<const SimCamera> models = {});

// The same with copies of other files as its models: <camera>.cahv, .cahvor or .cahvore of the
// folder `models`, as a calibration leaves them. An error names the camera that has none.
Result<void> write_calibrated_rig(const Scene& scene, const std::filesystem::path& folder,
                                  const std::filesystem::path& models);

// A binary 8-bit PGM.
Result<void> write_pgm(const std::filesystem::path& file, const ImageView& image);

}  // namespace dottrack::host_sim
