#include "app/core/image/arc_tangent.h"

#include <cstddef>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/arc_tangent.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// atan(t) for 0 <= t <= 1, to 2e-8 (Abramowitz and Stegun 4.4.49).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V arc_tangent_to_one(D d, V t) {
  const V z = hn::Mul(t, t);
  V series = hn::Set(d, 0.0028662257);
  for (const double c : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528, 1.0}) {
    series = hn::Add(hn::Mul(series, z), hn::Set(d, c));
  }
  return hn::Mul(t, series);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V arc_tangent(D d, V y, V x) {
  const V zero = hn::Zero(d);
  const V wide = hn::Max(hn::Abs(x), hn::Abs(y));
  const V angle = arc_tangent_to_one(d, hn::Div(hn::Min(hn::Abs(x), hn::Abs(y)), wide));
  const auto steep = hn::Gt(hn::Abs(y), hn::Abs(x));
  const auto behind = hn::Lt(x, zero);
  const V start = hn::IfThenElse(steep, hn::Set(d, std::numbers::pi / 2),
                                 hn::IfThenElseZero(behind, hn::Set(d, std::numbers::pi)));
  const V turned = hn::IfThenElse(hn::Xor(steep, behind), hn::Neg(angle), angle);
  const V sign_of = hn::Add(y, zero);  // -0 counts as 0
  return hn::IfThenZeroElse(hn::Eq(wide, zero), hn::CopySign(hn::Add(start, turned), sign_of));
}

template <class D>
HWY_INLINE std::size_t arc_tangents_by(D d, std::size_t i, std::span<const double> y,
                                       std::span<const double> x, std::span<double> angle) {
  for (; i + hn::Lanes(d) <= angle.size(); i += hn::Lanes(d)) {
    const auto all = arc_tangent(d, hn::LoadU(d, y.data() + i), hn::LoadU(d, x.data() + i));
    hn::StoreU(all, d, angle.data() + i);
  }
  return i;
}

void arc_tangents_of(std::span<const double> y, std::span<const double> x,
                     std::span<double> angle) {
  const std::size_t done = arc_tangents_by(hn::ScalableTag<double>(), 0, y, x, angle);
  arc_tangents_by(hn::CappedTag<double, 1>(), done, y, x, angle);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(arc_tangents_of);

void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> angle) {
  HWY_DYNAMIC_DISPATCH(arc_tangents_of)(y, x, angle);
}

}  // namespace dottrack::image
#endif
