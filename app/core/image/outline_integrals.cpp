#include "app/core/image/outline_integrals.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/outline_integrals.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/lane_totals-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace {

using Lanes = hn::CappedTag<float, kSumLanes>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));

// Half a turn in equal steps; the integrands are the same on the other half.
constexpr float kC1 = 0.92387953F;
constexpr float kC2 = 0.70710678F;
constexpr float kC3 = 0.38268343F;
constexpr std::array<float, kSumLanes> kCosine{1.0F, kC1, kC2, kC3, 0.0F, -kC3, -kC2, -kC1};
constexpr std::array<float, kSumLanes> kSine{0.0F, kC3, kC2, kC1, 1.0F, kC1, kC2, kC3};
constexpr double kPerTwoRootPi = 0.28209479177387814;
constexpr float kStep_rad = 0.785398163F;  // twice the step: the other half, too

HWY_INLINE Vector all(double value) {
  return hn::Set(kLanes, static_cast<float>(value));
}
HWY_INLINE Vector times(Vector a, Vector b) {
  return hn::Mul(a, b);
}

// Points of the outline, root e, and d place / d angle turned outwards: its length, the speed, is
// by how much a step of angle is longer along the outline, and h is root's determinant over it.
struct Points {
  HWY_INLINE Points(const Outline& outline, int first) {
    const Vector c = hn::LoadU(kLanes, kCosine.data() + first);
    const Vector s = hn::LoadU(kLanes, kSine.data() + first);
    const Vector r10 = all(outline.root(1, 0));
    const Vector r11 = all(outline.root(1, 1));
    x = times(all(outline.root(0, 0)), c);
    y = hn::Add(times(r10, c), times(r11, s));
    across_x = hn::Sub(times(r11, c), times(r10, s));
    across_y = times(all(outline.root(0, 0)), s);
    speed = hn::Sqrt(hn::Add(times(across_x, across_x), times(across_y, across_y)));
    per_speed = hn::Div(all(1.0), speed);
  }

  Vector x, y, across_x, across_y, speed, per_speed;
};

void shape(const OutlineModel& model, const Outline& outline, OutlineIntegrals& integrals) {
  using Term = OutlineIntegrals;
  SumLanes<Term::kTerms> lanes;
  const double blur2 = model.blur_px * model.blur_px;
  const Vector trace = all(blur2 * model.shape.trace());
  const Vector step = all(static_cast<double>(kStep_rad));
  const Vector two = all(2.0);
  for (int part = 0; part < static_cast<int>(kSumLanes); part += kStep) {
    const Points at(outline, part);
    const auto store = [&](Term::Term term, Vector value) {
      hn::StoreU(value, kLanes, lanes[term].data() + part);
    };
    const Vector across = times(step, at.per_speed);
    const Vector across_x = times(across, at.across_x);
    store(Term::kLength, times(step, at.speed));
    store(Term::kNxx, times(across_x, at.across_x));
    store(Term::kNxy, times(across_x, at.across_y));
    store(Term::kNyy, times(times(across, at.across_y), at.across_y));
    const Vector t = times(all(model.blur_px / outline.determinant), at.speed);
    const Vector tt = times(t, t);
    const Vector xx = times(at.x, at.x);
    const Vector xy = times(at.x, at.y);
    const Vector yy = times(at.y, at.y);
    const Vector step_t = times(step, t);
    store(Term::kT, step_t);
    store(Term::kTt, times(step_t, t));
    const Vector k = hn::Sub(trace, tt);
    const Vector once = times(step, hn::Add(all(1.0), hn::Sub(tt, k)));
    store(Term::kXx, times(once, xx));
    store(Term::kXy, times(once, xy));
    store(Term::kYy, times(once, yy));
    store(Term::kTxx, times(step_t, xx));
    store(Term::kTxy, times(step_t, xy));
    store(Term::kTyy, times(step_t, yy));
    const Vector kk = times(k, k);
    const Vector per_t = hn::Div(k, t);
    const Vector self = hn::Sub(times(all(0.5), hn::Add(all(1.0), kk)),
                                times(times(all(0.75), tt), hn::Add(hn::Add(k, k), kk)));
    store(Term::kBb, times(step, hn::Add(times(k, per_t), times(t, self))));
    const Vector lit = hn::Sub(all(kPerTwoRootPi), times(all(2.5 * kPerTwoRootPi), times(k, tt)));
    store(Term::kBe, times(step, hn::Add(times(all(0.5), hn::Sub(k, tt)), times(t, lit))));
    const Vector own =
        hn::Sub(times(all(0.75), times(k, tt)), hn::Add(all(1.0), times(all(0.5), kk)));
    const Vector by_form = times(step, hn::Add(hn::Sub(per_t, times(per_t, k)), times(t, own)));
    store(Term::kBxx, times(by_form, xx));
    store(Term::kBxy, times(by_form, xy));
    store(Term::kByy, times(by_form, yy));
    const Vector curved = hn::Sub(times(all(1.5), tt), times(k, hn::Sub(two, k)));
    const Vector h = times(all(outline.determinant), across);
    const Vector twice = hn::Add(h, times(h, curved));
    const Vector twice_xx = times(twice, xx);
    const Vector twice_yy = times(twice, yy);
    store(Term::kXxxx, times(twice_xx, xx));
    store(Term::kXxxy, times(twice_xx, xy));
    store(Term::kXxyy, times(twice_xx, yy));
    store(Term::kXyyy, times(twice_yy, xy));
    store(Term::kYyyy, times(twice_yy, yy));
  }
  for (std::size_t i = Term::kTerms; i < lanes.size(); ++i) lanes[i].fill(0.0F);
  total<Term::kTerms>(lanes, integrals.of.data());
}

constexpr std::size_t kThirds = 14;

void thirds(const Outline& outline, std::array<double, kThirds>& sums) {
  SumLanes<kThirds> lanes;
  const Vector determinant = all(outline.determinant);
  const Vector step = all(static_cast<double>(kStep_rad));
  for (int part = 0; part < static_cast<int>(kSumLanes); part += kStep) {
    const Points at(outline, part);
    std::size_t term = 0;
    const auto store = [&](Vector value) {
      hn::StoreU(value, kLanes, lanes[term++].data() + part);
    };
    const Vector xx = times(at.x, at.x);
    const Vector yy = times(at.y, at.y);
    const Vector step_speed = times(step, at.speed);
    store(times(step_speed, xx));
    store(times(step_speed, times(at.x, at.y)));
    store(times(step_speed, yy));
    const Vector cosine = times(at.x, hn::Sub(xx, times(all(3.0), yy)));
    const Vector sine = times(at.y, hn::Sub(times(all(3.0), xx), yy));
    const Vector area = times(step, determinant);
    const Vector h = times(determinant, at.per_speed);
    const Vector h_cosine = times(times(step, h), cosine);
    const Vector h_sine = times(times(step, h), sine);
    store(times(determinant, times(h_cosine, cosine)));
    store(times(determinant, times(h_cosine, sine)));
    store(times(determinant, times(h_sine, sine)));
    store(times(h_cosine, at.across_x));
    store(times(h_cosine, at.across_y));
    store(times(h_sine, at.across_x));
    store(times(h_sine, at.across_y));
    store(times(times(area, cosine), at.x));
    store(times(times(area, cosine), at.y));
    store(times(times(area, sine), at.x));
    store(times(times(area, sine), at.y));
  }
  for (std::size_t i = kThirds; i < lanes.size(); ++i) lanes[i].fill(0.0F);
  total<kThirds>(lanes, sums.data());
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(shape);
HWY_EXPORT(thirds);

Outline::Outline(const Eigen::Matrix2d& shape) {
  const double per = 1.0 / (shape(0, 0) * shape(1, 1) - shape(0, 1) * shape(1, 0));
  per_shape << per * shape(1, 1), -per * shape(0, 1), -per * shape(1, 0), per * shape(0, 0);
  root.setZero();
  root(0, 0) = std::sqrt(per_shape(0, 0));
  root(1, 0) = per_shape(1, 0) / root(0, 0);
  root(1, 1) = std::sqrt(per_shape(1, 1) - root(1, 0) * root(1, 0));
  determinant = root(0, 0) * root(1, 1);
}

OutlineIntegrals integrate(const OutlineModel& model, const Outline& outline) {
  OutlineIntegrals integrals;
  HWY_DYNAMIC_DISPATCH(shape)(model, outline, integrals);
  return integrals;
}

ThirdIntegrals integrate_thirds(const Outline& outline) {
  std::array<double, 14> sums;
  HWY_DYNAMIC_DISPATCH(thirds)(outline, sums);
  ThirdIntegrals thirds;
  thirds.place_place << sums[0], sums[1], sums[1], sums[2];
  thirds.third_third << sums[3], sums[4], sums[4], sums[5];
  thirds.third_normal << sums[6], sums[7], sums[8], sums[9];
  thirds.third_place << sums[10], sums[11], sums[12], sums[13];
  return thirds;
}

}  // namespace dottrack::image
#endif
