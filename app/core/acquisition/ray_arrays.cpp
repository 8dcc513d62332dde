#include "app/core/acquisition/ray_arrays.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/ray_arrays.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#ifndef DOTTRACK_ACQUISITION_SIGHTING_COLUMNS
#define DOTTRACK_ACQUISITION_SIGHTING_COLUMNS
namespace dottrack::acquisition {

// Of some sightings, side by side: what their rays are made of.
struct SightingColumns {
  static constexpr std::size_t kCapacity = 32;
  using Numbers = std::array<double, kCapacity>;

  alignas(64) std::array<Numbers, 3> direction{};
  alignas(64) std::array<Numbers, 3> x_per_rad{};
  alignas(64) std::array<Numbers, 3> y_per_rad{};
  alignas(64) std::array<Numbers, 2> pixel{};
  alignas(64) std::array<Numbers, 2> box_min_px{};
  alignas(64) std::array<Numbers, 2> box_max_px{};
  alignas(64) Numbers near_m{};
  alignas(64) Numbers far_m{};
};

// What a ray is held to besides.
struct RayLimits {
  double near_m;
  double far_m;
  double residual_px;
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
  HWY_INLINE Axis(const std::array<SightingColumns::Numbers, 3>& from, std::size_t i)
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

// The box's furthest from the centre, along one axis.
HWY_INLINE Vector corner(const SightingColumns& from, std::size_t axis, std::size_t i) {
  const Lanes lanes;
  const Vector centre = hn::Load(lanes, &from.pixel[axis][i]);
  return hn::Max(hn::Abs(hn::Sub(hn::Load(lanes, &from.box_max_px[axis][i]), centre)),
                 hn::Abs(hn::Sub(hn::Load(lanes, &from.box_min_px[axis][i]), centre)));
}

HWY_INLINE Vector box_tangent(const SightingColumns& from, const Axis& direction, std::size_t i,
                              double max_residual_px) {
  const Lanes lanes;
  const Vector half = hn::Set(lanes, 0.5);
  const Axis jx(from.x_per_rad, i);
  const Axis jy(from.y_per_rad, i);
  const Vector along_x = dot(jx, direction);  // nearly zero
  const Vector along_y = dot(jy, direction);
  const Vector off_x = hn::Abs(along_x);
  const Vector off_y = hn::Abs(along_y);
  const Vector in_box2_px = hn::Add(square(hn::Add(corner(from, 0, i), off_x)),
                                    square(hn::Add(corner(from, 1, i), off_y)));
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
  return hn::Sqrt(tangent2);
}

HWY_INLINE void put(Vector v, FloatArray& to, std::size_t i) {
  const hn::Rebind<float, Lanes> singles;
  hn::StoreU(hn::DemoteTo(singles, v), singles, &to[i]);
}

// A few beyond `size` may be written.
void put_rays(const SightingColumns& columns, std::size_t size, const RayLimits& limits,
              std::size_t to, RayArrays& rays) {
  const Lanes lanes;
  for (std::size_t i = 0; i < size; i += hn::Lanes(lanes)) {
    const Axis direction(columns.direction, i);
    put(direction.x, rays.x, to + i);
    put(direction.y, rays.y, to + i);
    put(direction.z, rays.z, to + i);
    put(hn::Max(hn::Load(lanes, &columns.near_m[i]), hn::Set(lanes, limits.near_m)), rays.near_m,
        to + i);
    put(hn::Min(hn::Load(lanes, &columns.far_m[i]), hn::Set(lanes, limits.far_m)), rays.far_m,
        to + i);
    put(box_tangent(columns, direction, i, limits.residual_px), rays.box_tangent, to + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {
namespace {

HWY_EXPORT(put_rays);

using estimation::Sighting;

constexpr double kLeastNear_m = 1e-6;  // so that it can be divided by

void put(const Sighting& sighting, SightingColumns& to, std::size_t i) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    to.direction[k][i] = sighting.line.ray.direction[axis];
    to.x_per_rad[k][i] = sighting.pixels_per_rad(0, axis);
    to.y_per_rad[k][i] = sighting.pixels_per_rad(1, axis);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    to.pixel[k][i] = sighting.pixel[axis];
    to.box_min_px[k][i] = sighting.box_min_px[axis];
    to.box_max_px[k][i] = sighting.box_max_px[axis];
  }
  to.near_m[i] = sighting.window.near_m;
  to.far_m[i] = sighting.window.far_m;
}

}  // namespace

void fill(RayArrays& rays, const core::Camera& camera, const estimation::Sightings& sightings,
          double max_residual_px) {
  const Eigen::Vector3d centre_m = geometry::centre(camera.model);
  const RayLimits limits{std::max(camera.distance_min_m, kLeastNear_m), camera.distance_max_m,
                         max_residual_px};
  Eigen::Vector3d direction_sum = Eigen::Vector3d::Zero();
  double offset2 = 0.0;
  rays.size = sightings.size();
  rays.centre_m = centre_m;
  SightingColumns columns;
  for (std::size_t from = 0; from < rays.size; from += SightingColumns::kCapacity) {
    const std::size_t size = std::min(SightingColumns::kCapacity, rays.size - from);
    for (std::size_t k = 0; k < size; ++k) {
      const Sighting& sighting = sightings[from + k];
      direction_sum += sighting.line.ray.direction;
      offset2 = std::max(offset2, (sighting.line.ray.origin - centre_m).squaredNorm());
      put(sighting, columns, k);
    }
    HWY_DYNAMIC_DISPATCH(put_rays)(columns, size, limits, from, rays);
  }
  rays.direction_sum = direction_sum;
  rays.origin_offset_m = std::sqrt(offset2);
}

}  // namespace dottrack::acquisition
#endif
