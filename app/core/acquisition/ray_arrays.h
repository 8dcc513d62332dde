#pragma once
// One camera's lines of sight as arrays of numbers, for the coarse first look of matching.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/core/estimation/sighting.h"
#include "app/core/rig.h"

namespace dottrack::acquisition {

// Room beyond the last element, so that whole vectors can be read.
inline constexpr std::size_t kSpareLanes = 8;
using FloatArray = std::array<float, core::kMaxRegions + kSpareLanes>;

struct RayArrays {
  alignas(32) FloatArray x{};  // direction, world
  alignas(32) FloatArray y{};
  alignas(32) FloatArray z{};
  // Where a dot may be along the ray; near > far where it may be nowhere.
  alignas(32) FloatArray near_m{};
  alignas(32) FloatArray far_m{};
  // Tangent of the angle off the ray beyond which no point projects into the bounding box.
  alignas(32) FloatArray box_tangent{};
  std::size_t size = 0;
  Eigen::Vector3d direction_sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double origin_offset_m = 0.0;  // furthest that a ray's origin is from the centre
};

// max_residual_px: further than this from its sighting's centre no point needs to project.
void fill(RayArrays& rays, const core::Camera& camera, const estimation::Sightings& sightings,
          double max_residual_px);

}  // namespace dottrack::acquisition
