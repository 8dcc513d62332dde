#include "app/core/acquisition/ray_arrays.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/ray_arrays.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#ifndef DOTTRACK_ACQUISITION_BOXES
#define DOTTRACK_ACQUISITION_BOXES
namespace dottrack::acquisition {

// Of some sightings, side by side: what their boxes' tangents are made of.
struct Boxes {
  static constexpr std::size_t kCapacity = 32;
  using Numbers = std::array<double, kCapacity>;

  alignas(64) std::array<Numbers, 3> direction{};
  alignas(64) std::array<Numbers, 3> x_per_rad{};
  alignas(64) std::array<Numbers, 3> y_per_rad{};
  alignas(64) std::array<Numbers, 2> corner_px{};  // the box's furthest, from the centre
  alignas(64) Numbers tangent{};
};

}  // namespace dottrack::acquisition
#endif

HWY_BEFORE_NAMESPACE();
namespace dottrack::acquisition {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Lanes>;

struct Axis {
  HWY_INLINE Axis(const std::array<Boxes::Numbers, 3>& from, std::size_t i)
      : x(hn::Load(Lanes(), &from[0][i])),
        y(hn::Load(Lanes(), &from[1][i])),
        z(hn::Load(Lanes(), &from[2][i])) {}
  Vector x, y, z;
};

HWY_INLINE Vector dot(const Axis& a, const Axis& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vector square(Vector v) {
  return hn::Mul(v, v);
}

void find_tangents(Boxes& boxes, std::size_t size, double max_residual_px) {
  const Lanes lanes;
  const Vector half = hn::Set(lanes, 0.5);
  for (std::size_t i = 0; i < size; i += hn::Lanes(lanes)) {
    const Axis direction(boxes.direction, i);
    const Axis jx(boxes.x_per_rad, i);
    const Axis jy(boxes.y_per_rad, i);
    const Vector along_x = dot(jx, direction);  // nearly zero
    const Vector along_y = dot(jy, direction);
    const Vector off_x = hn::Abs(along_x);
    const Vector off_y = hn::Abs(along_y);
    const Vector in_box2_px =
        hn::Add(square(hn::Add(hn::Load(lanes, &boxes.corner_px[0][i]), off_x)),
                square(hn::Add(hn::Load(lanes, &boxes.corner_px[1][i]), off_y)));
    const Vector residual_px = hn::Add(hn::Set(lanes, max_residual_px), hn::Add(off_x, off_y));
    const Vector reach2_px = hn::Min(in_box2_px, square(residual_px));
    // The smaller eigenvalue of J J^T for displacements across the ray: the slowest that the pixel
    // moves, squared.
    const Vector xx = hn::Sub(dot(jx, jx), square(along_x));
    const Vector yy = hn::Sub(dot(jy, jy), square(along_y));
    const Vector xy = hn::Sub(dot(jx, jy), hn::Mul(along_x, along_y));
    const Vector half_gap = hn::Mul(half, hn::Sub(xx, yy));
    const Vector least =
        hn::Sub(hn::Mul(half, hn::Add(xx, yy)), hn::Sqrt(hn::Add(square(half_gap), square(xy))));
    const Vector tangent2 = hn::Div(reach2_px, hn::Max(least, hn::Set(lanes, 1e-12)));
    hn::Store(hn::Sqrt(tangent2), lanes, &boxes.tangent[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {
namespace {

HWY_EXPORT(find_tangents);

using estimation::Sighting;

constexpr double kLeastNear_m = 1e-6;  // so that it can be divided by

void put(Boxes& boxes, std::size_t i, const Sighting& sighting) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    boxes.direction[k][i] = sighting.line.ray.direction[axis];
    boxes.x_per_rad[k][i] = sighting.pixels_per_rad(0, axis);
    boxes.y_per_rad[k][i] = sighting.pixels_per_rad(1, axis);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double centre_px = sighting.pixel[axis];
    boxes.corner_px[static_cast<std::size_t>(axis)][i] =
        std::max(std::abs(sighting.box_max_px[axis] - centre_px),
                 std::abs(sighting.box_min_px[axis] - centre_px));
  }
}

}  // namespace

void fill(RayArrays& rays, const core::Camera& camera, const estimation::Sightings& sightings,
          double max_residual_px) {
  const Eigen::Vector3d centre_m = geometry::centre(camera.model);
  Eigen::Vector3d direction_sum = Eigen::Vector3d::Zero();
  double offset2 = 0.0;
  rays.size = sightings.size();
  rays.centre_m = centre_m;
  Boxes boxes;
  for (std::size_t from = 0; from < rays.size; from += Boxes::kCapacity) {
    const std::size_t size = std::min(Boxes::kCapacity, rays.size - from);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = from + k;
      const Sighting& sighting = sightings[i];
      const Eigen::Vector3d& direction = sighting.line.ray.direction;
      direction_sum += direction;
      offset2 = std::max(offset2, (sighting.line.ray.origin - centre_m).squaredNorm());
      rays.x[i] = static_cast<float>(direction.x());
      rays.y[i] = static_cast<float>(direction.y());
      rays.z[i] = static_cast<float>(direction.z());
      rays.near_m[i] = static_cast<float>(
          std::max({sighting.window.near_m, camera.distance_min_m, kLeastNear_m}));
      rays.far_m[i] = static_cast<float>(std::min(sighting.window.far_m, camera.distance_max_m));
      put(boxes, k, sighting);
    }
    HWY_DYNAMIC_DISPATCH(find_tangents)(boxes, size, max_residual_px);
    for (std::size_t k = 0; k < size; ++k) {
      rays.box_tangent[from + k] = static_cast<float>(boxes.tangent[k]);
    }
  }
  rays.direction_sum = direction_sum;
  rays.origin_offset_m = std::sqrt(offset2);
}

}  // namespace dottrack::acquisition
#endif
