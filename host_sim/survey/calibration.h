#pragma once
// Camera models as a calibration would give them: fitted to dots that were surveyed with errors
// and seen with noise, so that their errors hang together as real ones do.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

struct CalibrationOptions {
  std::size_t dots_per_camera = 60;  // at most; drawn evenly from those in its picture
  double survey_sigma_m = 0.001;     // of each coordinate of a dot, the same for all cameras
  double image_sigma_px = 0.05;      // of each coordinate of a dot's centre in a picture
  std::uint64_t seed = 1;
};

// The calibrated cameras, in the order of `truths`. `dots`: where the calibration dots really are,
// world; nothing hides them. An error says which camera sees too few of them, or sees them in
// places that do not determine it.
Result<std::vector<SimCamera>> calibrated(std::span<const SimCamera> truths,
                                          std::span<const Eigen::Vector3d> dots,
                                          const CalibrationOptions& options);

// Places for calibration dots in a hall whose floor's middle is the world's origin: spread evenly
// over the floor and, up to `height_m`, over the four walls.
std::vector<Eigen::Vector3d> calibration_dots(double length_m, double width_m, double height_m,
                                              std::size_t count, std::uint64_t seed);

}  // namespace dottrack::host_sim
