#include "app/core/acquisition/pencil.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/pencil.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::acquisition {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kSpareLanes>;
using Vector = hn::Vec<Lanes>;

// Margins for single precision. Components of a direction are known to 4.3e-7, so a plane's angle
// to 5.5e-5 (kLeastSine) and twice that between two rays; a cotangent c to 4e-7 (1 + |c|)^2.
constexpr float kAngleMargin = 1.5e-4F;
constexpr float kSineMargin = 1e-6F;
constexpr float kCotangentMargin = 2e-6F;  // times 1 + c^2
constexpr float kGreatestCotangent = 1.0F / PencilRays::kLeastSine;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

HWY_INLINE Vector all(float value) {
  return hn::Set(Lanes(), value);
}

HWY_INLINE Vector all(double value) {
  return all(static_cast<float>(value));
}

// Without fused multiplication: the same bits on every processor.
HWY_INLINE Vector multiply_add(Vector a, Vector b, Vector c) {
  return hn::Add(hn::Mul(a, b), c);
}

HWY_INLINE Vector dot(Vector x, Vector y, Vector z, const Eigen::Vector3d& axis) {
  return multiply_add(x, all(axis.x()), multiply_add(y, all(axis.y()), hn::Mul(z, all(axis.z()))));
}

// As std::atan2, to 5e-7 (Abramowitz and Stegun 4.4.49).
HWY_INLINE Vector arc_tangent(Vector y, Vector x) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const Vector wide_y = hn::Abs(y);
  const Vector wide_x = hn::Abs(x);
  const Vector t = hn::Div(hn::Min(wide_x, wide_y), hn::Max(hn::Max(wide_x, wide_y), all(1e-30F)));
  const Vector z = hn::Mul(t, t);
  Vector series = all(0.0028662257F);
  for (const float c : {-0.0161657367F, 0.0429096138F, -0.0752896400F, 0.1065626393F,
                        -0.1420889944F, 0.1999355085F, -0.3333314528F, 1.0F}) {
    series = multiply_add(series, z, all(c));
  }
  Vector angle = hn::Mul(t, series);
  angle = hn::IfThenElse(hn::Gt(wide_y, wide_x), hn::Sub(all(0.5F * kPi), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, all(0.0F)), hn::Sub(all(kPi), angle), angle);
  return hn::CopySign(angle, y);
}

// One ray in each lane: what its own window, box and place ask of the other camera's ray.
// The constructors are spelled out: those of the compiler's making would be built for another
// processor.
struct Wishes {
  HWY_INLINE Wishes() {}
  Vector half_width, low, high, miss_slope, miss_offset;
};

struct Ray {
  HWY_INLINE Ray() {}
  Vector angle, sine, cosine, cotangent, near, far, box_tangent;
};

// How far the other's plane may be off: by the bounding box, and by the largest miss at the nearest
// range. Infinite where the interval would reach over the back of the pencil.
HWY_INLINE Vector half_width(const Pencil& pencil, const Ray& ray) {
  const Vector by_box = hn::Add(ray.box_tangent, ray.box_tangent);
  const Vector off = hn::Min(hn::Mul(by_box, ray.near), all(pencil.max_miss_m));
  const Vector sine_between =
      hn::Div(hn::Mul(hn::Add(off, all(pencil.origin_offset_m)), all(1.0F + kRoundingPart)),
              hn::Mul(ray.near, hn::Max(hn::Sub(ray.sine, all(kSineMargin)), all(1e-30F))));
  // asin x <= x + (pi / 2 - 1) x^3
  const Vector cube = hn::Mul(sine_between, hn::Mul(sine_between, sine_between));
  const Vector width = hn::Add(multiply_add(cube, all(0.5708F), sine_between), all(kAngleMargin));
  const auto known = hn::And(hn::Lt(sine_between, all(1.0F)),
                             hn::Lt(hn::Add(hn::Abs(ray.angle), width), all(3.1415F)));
  const Vector finite = hn::IfThenElse(known, width, all(kInfinity));
  return hn::IfThenElse(hn::Le(ray.near, ray.far), finite, all(-1.0F));
}

// (B +- mu - rho c) / (rho -+ mu) at the window's ends, for the greatest and the least value.
HWY_INLINE void cotangent_interval(const Pencil& pencil, const Ray& ray, Vector mu,
                                   Wishes& wishes) {
  const Vector baseline = all(pencil.baseline_m);
  const auto quotient = [&](Vector range, Vector above, Vector mu_if_above) {
    const Vector top = hn::Sub(above, hn::Mul(range, ray.cosine));
    const Vector slack = hn::IfThenElse(hn::Gt(top, all(0.0F)), mu_if_above, hn::Neg(mu_if_above));
    return hn::Div(top, multiply_add(range, ray.sine, slack));
  };
  const Vector most = hn::Add(baseline, mu);
  const Vector least = hn::Sub(baseline, mu);
  const Vector high =
      hn::Max(quotient(ray.near, most, hn::Neg(mu)), quotient(ray.far, most, hn::Neg(mu)));
  const Vector low = hn::Min(quotient(ray.near, least, mu), quotient(ray.far, least, mu));
  const auto widening = [](Vector c) {
    return hn::Mul(all(kCotangentMargin), multiply_add(c, c, all(1.0F)));
  };
  const auto bounded = hn::Gt(hn::Mul(ray.near, ray.sine), mu);
  wishes.low = hn::IfThenElse(bounded, hn::Sub(low, widening(low)), all(-kInfinity));
  wishes.high = hn::IfThenElse(bounded, hn::Add(high, widening(high)), all(kInfinity));
}

// sin |phi| <= mu / rho, and 1 / rho <= (c_a + c_b) / (B - mu (1 + |c|)).
HWY_INLINE void miss_bound(const Pencil& pencil, const Ray& ray, Vector mu, Wishes& wishes) {
  const Vector one = all(1.0F);
  const Vector length =
      hn::Sub(all(pencil.baseline_m), hn::Mul(mu, hn::Add(one, hn::Abs(ray.cotangent))));
  // x / sin x <= 1 + 0.1885 x^2 up to 1
  const Vector& h = wishes.half_width;
  const Vector stretch =
      multiply_add(hn::Mul(h, h), all(0.1885F), all(1.0F + 10.0F * kRoundingPart));
  const Vector slope = hn::Div(hn::Mul(mu, stretch), length);
  const Vector other =
      hn::Min(hn::Max(hn::Abs(wishes.low), hn::Abs(wishes.high)), all(kGreatestCotangent));
  const Vector squares = multiply_add(ray.cotangent, ray.cotangent, hn::Mul(other, other));
  const Vector error = hn::Mul(all(kCotangentMargin), hn::Add(squares, all(2.0F)));
  const auto useful = hn::And(hn::Gt(length, all(0.5 * pencil.baseline_m)), hn::Le(h, one));
  wishes.miss_slope = hn::IfThenElseZero(useful, slope);
  wishes.miss_offset =
      hn::IfThenElse(useful, multiply_add(slope, error, all(kAngleMargin)), all(kInfinity));
}

HWY_INLINE Wishes wishes_of(const Pencil& pencil, const Ray& ray) {
  const Vector mu = multiply_add(hn::Add(all(pencil.baseline_m), ray.far), all(kRoundingPart),
                                 all(pencil.max_miss_m + pencil.origin_offset_m));
  Wishes wishes;
  wishes.half_width = half_width(pencil, ray);
  cotangent_interval(pencil, ray, mu, wishes);
  miss_bound(pencil, ray, mu, wishes);
  return wishes;
}

HWY_INLINE Ray load(const Pencil& pencil, const Eigen::Vector3d& inwards, const RayArrays& rays,
                    std::size_t i) {
  const Lanes lanes;
  const Vector x = hn::Load(lanes, &rays.x[i]);
  const Vector y = hn::Load(lanes, &rays.y[i]);
  const Vector z = hn::Load(lanes, &rays.z[i]);
  const Vector across = dot(x, y, z, pencil.across);
  const Vector up = dot(x, y, z, pencil.up);
  Ray ray;
  ray.angle = arc_tangent(up, across);
  ray.sine = hn::Sqrt(multiply_add(across, across, hn::Mul(up, up)));
  ray.cosine = dot(x, y, z, inwards);
  ray.cotangent = hn::Div(ray.cosine, ray.sine);
  ray.near = hn::Load(lanes, &rays.near_m[i]);
  ray.far = hn::Load(lanes, &rays.far_m[i]);
  ray.box_tangent = hn::Load(lanes, &rays.box_tangent[i]);
  return ray;
}

void unfold_rays(const Pencil& pencil, const Eigen::Vector3d& inwards, const RayArrays& rays,
                 PencilRays& result) {
  const Lanes lanes;
  Vector least = all(kInfinity);
  Vector greatest = all(-kInfinity);
  result.stray.clear();
  for (std::size_t i = 0; i < rays.size; i += hn::Lanes(lanes)) {
    const Ray ray = load(pencil, inwards, rays, i);
    const Wishes wishes = wishes_of(pencil, ray);
    hn::Store(ray.angle, lanes, &result.angle[i]);
    hn::Store(ray.cotangent, lanes, &result.cotangent[i]);
    hn::Store(ray.sine, lanes, &result.sine[i]);
    hn::Store(wishes.half_width, lanes, &result.half_width[i]);
    hn::Store(wishes.low, lanes, &result.low[i]);
    hn::Store(wishes.high, lanes, &result.high[i]);
    hn::Store(wishes.miss_slope, lanes, &result.miss_slope[i]);
    hn::Store(wishes.miss_offset, lanes, &result.miss_offset[i]);
    const auto taken =
        hn::And(hn::Ge(ray.sine, all(PencilRays::kLeastSine)), hn::FirstN(lanes, rays.size - i));
    least = hn::Min(least, hn::IfThenElse(taken, ray.angle, all(kInfinity)));
    greatest = hn::Max(greatest, hn::IfThenElse(taken, ray.angle, all(-kInfinity)));
    const std::size_t real = std::min(hn::Lanes(lanes), rays.size - i);
    if (hn::CountTrue(lanes, taken) == real) continue;
    for (std::size_t k = i; k < i + real; ++k) {
      if (result.is_stray(k)) result.stray.push_back(static_cast<std::uint16_t>(k));
    }
  }
  result.least_angle = hn::GetLane(hn::MinOfLanes(lanes, least));
  result.greatest_angle = hn::GetLane(hn::MaxOfLanes(lanes, greatest));
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {

HWY_EXPORT(unfold_rays);

Pencil::Pencil(const RayArrays& a, const RayArrays& b, double max_miss)
    : max_miss_m(max_miss), origin_offset_m(a.origin_offset_m + b.origin_offset_m) {
  const Eigen::Vector3d baseline = b.centre_m - a.centre_m;
  baseline_m = baseline.norm();
  if (!has_baseline()) return;
  along = baseline / baseline_m;
  const Eigen::Vector3d to_scene = a.direction_sum + b.direction_sum;
  const Eigen::Vector3d off = to_scene - to_scene.dot(along) * along;
  across = off.norm() > 1e-9 * to_scene.norm() ? off.normalized() : along.unitOrthogonal();
  up = along.cross(across);
}

void unfold(const Pencil& pencil, PencilEnd end, const RayArrays& rays, PencilRays& result) {
  const Eigen::Vector3d inwards = end == PencilEnd::a ? 1.0 * pencil.along : -1.0 * pencil.along;
  HWY_DYNAMIC_DISPATCH(unfold_rays)(pencil, inwards, rays, result);
}

}  // namespace dottrack::acquisition
#endif
