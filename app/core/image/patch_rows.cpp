#include "app/core/image/patch_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/patch_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
using Integers = hn::RebindToSigned<Lanes>;
using Vector = hn::Vec<Lanes>;
using Integer = hn::Vec<Integers>;
constexpr Lanes kLanes;
constexpr Integers kIntegers;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));
static_assert(kPatchRows_px % 8 == 0 && kPatchRows_px >= kMaxPatchSide_px);

HWY_INLINE Vector all(double value) {
  return hn::Set(kLanes, static_cast<float>(value));
}

// Rounding towards zero is rounding down.
constexpr int kBias = 256;

HWY_INLINE Integer floor_of(Vector v) {
  return hn::Sub(hn::ConvertTo(kIntegers, hn::Add(v, all(kBias))), hn::Set(kIntegers, kBias));
}
HWY_INLINE Integer ceiling_of(Vector v) {
  return hn::Sub(hn::Set(kIntegers, kBias), hn::ConvertTo(kIntegers, hn::Sub(all(kBias), v)));
}

HWY_INLINE void store(Integer v, std::int16_t* to) {
  const hn::Rebind<std::int16_t, Integers> narrow;
  hn::StoreU(hn::DemoteTo(narrow, v), narrow, to);
}

HWY_INLINE std::int64_t total(Integer v) {
  return hn::GetLane(hn::SumOfLanes(kIntegers, v));
}

// With n columns from first to last and m = first + last: 2 sum x = n m,
// 12 sum x^2 = 3 n m^2 + n^3 - n. A patch's sums have room in 32 bits.
void span(const GrownEllipse& ellipse, const Eigen::Vector2d& centre, int rows, int columns,
          Spans& spans) {
  const double one_per_a = 1.0 / ellipse.a;
  const Vector per_a = all(one_per_a);
  const Vector a = all(ellipse.a);
  const Vector determinant = all(ellipse.determinant);
  const Vector slant = all(ellipse.b * one_per_a);
  const Vector middle_x = all(centre.x());
  const Vector middle_y = all(centre.y());
  const Integer one = hn::Set(kIntegers, 1);
  const Integer none = hn::Zero(kIntegers);
  Integer n_sum = none, y_sum = none, yy_sum = none, x2_sum = none, xx12_sum = none, xy2_sum = none;
  for (int row = 0; row < rows; row += kStep) {
    const Integer y = hn::Iota(kIntegers, row);
    const Vector down = hn::Sub(hn::ConvertTo(kLanes, y), middle_y);
    const Vector inside = hn::Sub(a, hn::Mul(determinant, hn::Mul(down, down)));
    const Vector half = hn::Mul(hn::Sqrt(hn::Max(inside, all(0.0))), per_a);
    const Vector middle = hn::Sub(middle_x, hn::Mul(slant, down));
    const Integer first =
        hn::Min(hn::Max(ceiling_of(hn::Sub(middle, half)), none), hn::Set(kIntegers, columns));
    const Integer past =
        hn::Min(hn::Add(floor_of(hn::Add(middle, half)), one), hn::Set(kIntegers, columns));
    const auto hit = hn::And(hn::RebindMask(kIntegers, hn::Ge(inside, all(0.0))),
                             hn::Lt(y, hn::Set(kIntegers, rows)));
    const Integer after = hn::IfThenElse(hit, hn::Max(past, first), first);
    const Integer n = hn::Sub(after, first);
    const Integer before = hn::Sub(first, one);
    const Integer m = hn::Add(before, after);
    const Integer nm = hn::Mul(n, m);
    const Integer ny = hn::Mul(n, y);
    n_sum = hn::Add(n_sum, n);
    y_sum = hn::Add(y_sum, ny);
    yy_sum = hn::Add(yy_sum, hn::Mul(ny, y));
    x2_sum = hn::Add(x2_sum, nm);
    xy2_sum = hn::Add(xy2_sum, hn::Mul(nm, y));
    xx12_sum = hn::Add(
        xx12_sum,
        hn::Mul(n, hn::Sub(hn::Add(hn::Mul(hn::Set(kIntegers, 3), hn::Mul(m, m)), hn::Mul(n, n)),
                           one)));
    store(before, spans.before.data() + row);
    store(after, spans.after.data() + row);
  }
  spans.places = {total(n_sum),         total(x2_sum) / 2,  total(y_sum),
                  total(xx12_sum) / 12, total(xy2_sum) / 2, total(yy_sum)};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(span);

void set_spans(const GrownEllipse& ellipse, const Eigen::Vector2d& centre, int rows, int columns,
               Spans& spans) {
  HWY_DYNAMIC_DISPATCH(span)(ellipse, centre, rows, columns, spans);
}

}  // namespace dottrack::image
#endif
