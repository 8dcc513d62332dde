#pragma once
// A camera to start from.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "app/workstation/calibrate/fit/camera_numbers.h"

namespace dottrack::calibrate {

struct Labelled {
  std::span<const Eigen::Vector3d> points;  // metres, world
  std::span<const Eigen::Vector2d> pixels;
};

// A pinhole camera from labelled points some of which may be wrong: fit_cahv on all, then on those
// that agree; where most do not agree, on samples. The same every time.
std::optional<geometry::Cahv> start_from(const Labelled& labelled, ImageExtent extent);

// Whether the points are in one plane, or nearly.
bool in_a_plane(std::span<const Eigen::Vector3d> points);

// Throws a camera off: some degrees, a tenth of its distance and of its focal length.
void throw_off(NumberedCamera& camera, std::uint64_t seed);

}  // namespace dottrack::calibrate
