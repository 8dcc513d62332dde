#include "app/core/image/moments.h"

#include <numbers>

#include "app/core/image/arc_tangent.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/moments.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

// The sums of several components, and what becomes of them, one component a lane.
#ifndef DOTTRACK_IMAGE_MOMENT_COLUMNS
#define DOTTRACK_IMAGE_MOMENT_COLUMNS
namespace dottrack::image {
struct MomentColumns {
  Moments::Column n, x, y, xx, xy, yy, w, wx, wy, width, height;
  Moments::Column tilt_y, tilt_x;  // the vector at twice the major axis' angle
};
}  // namespace dottrack::image
#endif

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, 4>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;

HWY_INLINE Vector at(const Moments::Column& column, std::size_t i) {
  return hn::LoadU(kLanes, column.data() + i);
}
HWY_INLINE void put(Vector v, Moments::Column& column, std::size_t i) {
  hn::StoreU(v, kLanes, column.data() + i);
}

HWY_INLINE void set_centroids(const MomentColumns& of, std::size_t i, Moments& to) {
  const Vector per_weight = hn::Div(hn::Set(kLanes, 1.0), at(of.w, i));
  put(hn::Mul(at(of.wx, i), per_weight), to.x, i);
  put(hn::Mul(at(of.wy, i), per_weight), to.y, i);
}

HWY_INLINE Vector semi_axis(Vector variance) {
  const Vector pixel = hn::Set(kLanes, 1.0 / 12.0);
  return hn::Mul(hn::Set(kLanes, 2.0), hn::Sqrt(hn::Add(variance, pixel)));
}

// How far the sides of the ellipse's bounding box are from those of the region's along one axis,
// the further of the two. Pixels reach half a pixel beyond their centres.
HWY_INLINE Vector misfit(Vector mean, Vector variance, Vector extent) {
  const Vector half = hn::Set(kLanes, 0.5);
  const Vector half_extent = hn::Mul(half, extent);
  const Vector off_centre = hn::Abs(hn::Sub(hn::Add(mean, half), half_extent));
  return hn::Add(off_centre, hn::Abs(hn::Sub(half_extent, semi_axis(variance))));
}

HWY_INLINE void set_ellipses(MomentColumns& of, std::size_t i, Moments& to) {
  const Vector half = hn::Set(kLanes, 0.5);
  const Vector per_pixel = hn::Div(hn::Set(kLanes, 1.0), at(of.n, i));
  const Vector x = hn::Mul(at(of.x, i), per_pixel);
  const Vector y = hn::Mul(at(of.y, i), per_pixel);
  const Vector xx = hn::Sub(hn::Mul(at(of.xx, i), per_pixel), hn::Mul(x, x));
  const Vector xy = hn::Sub(hn::Mul(at(of.xy, i), per_pixel), hn::Mul(x, y));
  const Vector yy = hn::Sub(hn::Mul(at(of.yy, i), per_pixel), hn::Mul(y, y));
  const Vector middle = hn::Mul(half, hn::Add(xx, yy));
  const Vector half_difference = hn::Mul(half, hn::Sub(xx, yy));
  const Vector radius =
      hn::Sqrt(hn::Add(hn::Mul(half_difference, half_difference), hn::Mul(xy, xy)));
  const Vector major = semi_axis(hn::Add(middle, radius));
  const Vector minor = semi_axis(hn::Max(hn::Sub(middle, radius), hn::Zero(kLanes)));
  const Vector area = hn::Mul(hn::Mul(hn::Set(kLanes, std::numbers::pi), major), minor);
  put(major, to.semi_major, i);
  put(minor, to.semi_minor, i);
  put(hn::Div(at(of.n, i), area), to.fill, i);
  put(hn::Max(misfit(x, xx, at(of.width, i)), misfit(y, yy, at(of.height, i))), to.box_misfit, i);
  put(xy, of.tilt_y, i);
  put(half_difference, of.tilt_x, i);
}

void from_columns(MomentColumns& of, std::size_t count, Moments& to) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(kLanes)) {
    set_centroids(of, i, to);
    set_ellipses(of, i, to);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(from_columns);

namespace {

void put_sums(const RegionSums& sums, const PixelWeights& weights, std::size_t i,
              MomentColumns& to) {
  const double sign = weights.sign;
  const double offset = weights.offset;
  const auto& of = sums.of;
  to.n[i] = sums.n;
  to.width[i] = sums.width;
  to.height[i] = sums.height;
  to.x[i] = of[RegionSums::kX];
  to.y[i] = of[RegionSums::kY];
  to.xx[i] = of[RegionSums::kXx];
  to.xy[i] = of[RegionSums::kXy];
  to.yy[i] = of[RegionSums::kYy];
  to.w[i] = sign * of[RegionSums::kV] + offset * sums.n;
  to.wx[i] = sign * of[RegionSums::kVx] + offset * of[RegionSums::kX];
  to.wy[i] = sign * of[RegionSums::kVy] + offset * of[RegionSums::kY];
}

}  // namespace

Eigen::Vector2d centroid(const RegionSums& sums, const PixelWeights& weights) {
  const auto& of = sums.of;
  const double sign = weights.sign;
  const double offset = weights.offset;
  const double per_weight = 1.0 / (sign * of[RegionSums::kV] + offset * sums.n);
  return {(sign * of[RegionSums::kVx] + offset * of[RegionSums::kX]) * per_weight,
          (sign * of[RegionSums::kVy] + offset * of[RegionSums::kY]) * per_weight};
}

void measure(std::span<const RegionSums> sums, const PixelWeights& weights, Moments& moments) {
  constexpr std::size_t kLanes = 4;  // the last few components are repeated to fill a vector
  MomentColumns columns;
  std::size_t count = 0;
  for (const RegionSums& of_one : sums) put_sums(of_one, weights, count++, columns);
  for (; count % kLanes != 0; ++count) put_sums(sums.back(), weights, count, columns);
  HWY_DYNAMIC_DISPATCH(from_columns)(columns, count, moments);
  arc_tangents({columns.tilt_y.data(), count}, {columns.tilt_x.data(), count},
               {moments.angle_rad.data(), count});
  for (std::size_t i = 0; i < count; ++i) moments.angle_rad[i] *= 0.5;
}

}  // namespace dottrack::image
#endif
