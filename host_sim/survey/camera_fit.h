#pragma once
// A camera fitted to dots whose places were surveyed: what a calibration does.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

// A dot as its surveyor and the camera have it.
struct Sighting {
  Eigen::Vector3d surveyed_m;  // world
  Eigen::Vector2d pixel;
};

struct SightingErrors {
  double survey_m = 0.001;  // standard deviations, of each coordinate
  double image_px = 0.05;
};

// The numbers that are fitted: place and attitude (6), focal lengths (2), principal point (2) and,
// unless the lens is a pinhole, the radial terms r1 and r2. All else stays as in `start`, the
// direction of the lens's axis in the camera among it.
inline constexpr std::size_t kMostFitted = 12;
std::size_t fitted_numbers(LensKind kind);

// The camera that explains the sightings best, each weighted by the errors it may have;
// Levenberg-Marquardt from `start`, which must see all the dots. Nothing if they do not determine
// it.
std::optional<SimCamera> fitted(const SimCamera& start, std::span<const Sighting> sightings,
                                const SightingErrors& errors);

}  // namespace dottrack::host_sim
