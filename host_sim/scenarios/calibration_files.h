#pragma once
// What a surveyor and an installer hand to a calibration of a scene's cameras, and the truth that
// its result is held against.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

struct SurveyOptions {
  double sigma_m = 0.001;      // of each coordinate of a dot
  std::size_t wrong_dots = 0;  // whose survey is off by 3 to 10 cm
  std::uint64_t seed = 1;
};

// Into a folder that is there: dots.csv (as surveyed) and truth_dots.csv with
// `dot,x_m,y_m,z_m,sigma_m,diameter_m,nx,ny,nz` in world coordinates; approximate/, a rig whose
// cameras are off by some degrees, decimetres and per cent of the focal length, without distortion;
// truth/, the true rig. The wrong dots' names, in the files' order. An error says what cannot be
// written, or that the hall has too few dots.
Result<std::vector<std::string>> write_calibration(const Scene& scene, const SurveyOptions& options,
                                                   const std::filesystem::path& folder);

}  // namespace dottrack::host_sim
