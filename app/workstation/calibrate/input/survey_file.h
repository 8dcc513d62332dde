#pragma once
// Surveyed dots, places of cameras and seeds, as people write them down.

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/workstation/calibrate/views.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

// dot (or id), x_m, y_m, z_m and, if known, sigma_m (or sigma_x_m, sigma_y_m, sigma_z_m),
// diameter_m, nx, ny, nz, tick; lengths in _m, _cm or _mm. World coordinates, right-handed. An
// error names the file and the line.
Result<std::vector<SurveyedDot>> read_survey(const std::filesystem::path& path);

// camera, x_m, y_m, z_m: about where each camera is, world.
Result<std::map<std::string, Eigen::Vector3d>> read_places(const std::filesystem::path& path);

// A dot and about where a camera shows it.
struct Seed {
  std::size_t dot = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// camera, dot, x_px, y_px and, for dots that are carried about, tick. An error names a dot that the
// survey does not know, or a camera with fewer than four.
Result<std::map<std::string, std::vector<Seed>>> read_seeds(const std::filesystem::path& path,
                                                            std::span<const SurveyedDot> dots);

}  // namespace dottrack::calibrate
