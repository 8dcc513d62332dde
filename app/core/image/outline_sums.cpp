#include "app/core/image/outline_sums.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/outline_sums.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/image/lane_totals-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
using Lanes = hn::CappedTag<float, DotPixels::kBlock>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));
constexpr int kBlock = DotPixels::kBlock;
static_assert(kSumLanes == static_cast<std::size_t>(kBlock));

HWY_INLINE Vector all(double value) {
  return hn::Set(kLanes, static_cast<float>(value));
}

// Up to |z| = kCut, where the normal distribution is cut off, scaled to end at 0 and 1. Density:
// (kCut^2 - u) (c0 + c1 u + ...) with u = z^2, to 1.5e-4 and 0 at the end. Distribution: 1/2 + z
// (c0 + c1 u + ...), to 4e-5. By halves, which wait less for each other than one term after the
// other.
constexpr double kCut = 3.0;
constexpr std::array<double, 5> kDensity{0.044430453037494308, -0.017116088516842362,
                                         0.0033649602068658306, -0.00036752271209737245,
                                         1.7844346881829664e-05};
constexpr std::array<double, 6> kDistribution{0.3998475676541523,     -0.066074289196162109,
                                              0.0094107179529879653,  -0.00093105264069910166,
                                              5.5706351321884743e-05, -1.4825877421502016e-06};

HWY_INLINE Vector linear(Vector u, double c0, double c1) {
  return hn::Add(hn::Mul(all(c1), u), all(c0));
}

// How much of a pixel is covered, and the density there; |z| is at most kCut.
struct Normal {
  HWY_INLINE explicit Normal(Vector z) {
    const Vector u = hn::Mul(z, z);
    const Vector u2 = hn::Mul(u, u);
    const auto& d = kDistribution;
    const Vector high = hn::Add(linear(u, d[2], d[3]), hn::Mul(linear(u, d[4], d[5]), u2));
    const Vector e_per_z = hn::Add(linear(u, d[0], d[1]), hn::Mul(high, u2));
    e = hn::Add(all(0.5), hn::Mul(z, e_per_z));
    const auto& c = kDensity;
    const Vector tail = hn::Add(linear(u, c[2], c[3]), hn::Mul(all(c[4]), u2));
    p = hn::Mul(hn::Sub(all(kCut * kCut), u), hn::Add(linear(u, c[0], c[1]), hn::Mul(tail, u2)));
  }

  Vector e, p;
};

struct LaneModel {
  HWY_INLINE explicit LaneModel(const OutlineModel& model)
      : x(all(model.centre.x())),
        y(all(model.centre.y())),
        xx(all(model.shape(0, 0))),
        xy(all(model.shape(0, 1))),
        yy(all(model.shape(1, 1))),
        trace(all(model.shape.trace())),
        blur2(all(model.blur_px * model.blur_px)),
        per_blur(all(1.0 / model.blur_px)),
        contrast(all(model.contrast_dn)),
        background(all(model.background_dn)),
        per_x(all(model.slope_dn.x())),
        per_y(all(model.slope_dn.y())),
        e_outside(Normal(all(-kCut)).e),
        e_inside(Normal(all(kCut)).e) {}

  Vector x, y, xx, xy, yy, trace, blur2, per_blur, contrast, background, per_x, per_y;
  Vector e_outside, e_inside;
};

// Where some pixels are: from the centre, and z of them; the outline moves by h_per_m where u^T A u
// does by 2.
struct Place {
  // Spelled out: a constructor of the compiler's making would be built for another processor.
  HWY_INLINE Place() {}
  HWY_INLINE Place(Vector x_of, Vector y_of, Vector z_of, Vector h_per_m_of)
      : x(x_of), y(y_of), z(z_of), h_per_m(h_per_m_of) {}

  Vector x, y, z, h_per_m;
};

// With m = sqrt(u^T A u) a point is h (1 - m) inside the outline, h = m / |A u|. Blur moves a
// curved edge inwards: the mean of m over a Gaussian about u is m + blur^2 Laplacian(m) / 2, with
// Laplacian(m) = (trace A - 1 / h^2) / m.
HWY_INLINE Place place_at(const LaneModel& model, Vector x, Vector y) {
  const Vector tiny = all(1e-4);  // the middle of the dot divides by nothing
  const Vector gx = hn::Add(hn::Mul(model.xx, x), hn::Mul(model.xy, y));
  const Vector gy = hn::Add(hn::Mul(model.xy, x), hn::Mul(model.yy, y));
  const Vector q = hn::Add(hn::Mul(x, gx), hn::Mul(y, gy));
  const Vector g2 = hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
  const Vector g2_off = hn::Add(g2, hn::Mul(model.trace, all(0.5e-4)));
  const Vector q_off = hn::Add(q, tiny);
  const Vector per_h2 = hn::Div(g2_off, q_off);
  const Vector m2 = hn::Add(q, hn::Mul(model.blur2, hn::Sub(model.trace, per_h2)));
  const Vector h_per_m = hn::Div(all(1.0), hn::Sqrt(hn::Mul(per_h2, m2)));
  const Vector in_blurs = hn::Mul(h_per_m, model.per_blur);
  return {x, y, hn::Mul(in_blurs, hn::Sub(hn::Sqrt(m2), m2)), h_per_m};
}

// The places of some blocks. They are worked out before anything is summed: then many roots and
// divisions are under way at once.
class Places {
 public:
  static constexpr int kBlocks = 16;

  HWY_INLINE Places() {}

  HWY_INLINE void set(const DotPixels& pixels, const LaneModel& model, int first, int end) {
    int block = 0;
    for (int i = first; i < end; i += kBlock, ++block) {
      const auto at = static_cast<std::size_t>(i);
      const Vector x = hn::Sub(hn::LoadU(kLanes, pixels.x.data() + at), model.x);
      const Vector y = hn::Sub(hn::LoadU(kLanes, pixels.y.data() + at), model.y);
      of_[block] = place_at(model, x, y);
    }
  }
  HWY_INLINE const Place& operator[](int block) const { return of_[block]; }

 private:
  Place of_[kBlocks];
};

// Of some pixels against the outline. Where none is on the blurred edge, p, pz and w are nothing.
struct Edge {
  Vector e, p, pz, w;
  bool any;
};

HWY_INLINE Edge edge_at(const LaneModel& model, const Place& place) {
  const Vector z = place.z;
  const auto near = hn::Lt(hn::Abs(z), all(kCut));
  if (hn::AllFalse(kLanes, near)) {
    const Vector none = hn::Zero(kLanes);
    const Vector e = hn::IfThenElse(hn::Gt(z, none), model.e_inside, model.e_outside);
    return {e, none, none, none, false};
  }
  const Vector cut = hn::Min(hn::Max(z, all(-kCut)), all(kCut));
  const Normal normal(cut);
  return {normal.e, normal.p, hn::Mul(normal.p, cut), hn::Mul(normal.p, place.h_per_m), true};
}

template <std::size_t kTerms>
class LaneSums {
 public:
  HWY_INLINE LaneSums() {
    for (Vector& sum : of_) sum = hn::Zero(kLanes);
  }
  HWY_INLINE void add(std::size_t term, Vector value) { of_[term] = hn::Add(of_[term], value); }
  HWY_INLINE void store(int first, SumLanes<kTerms>& to) const {
    for (std::size_t i = 0; i < kTerms; ++i) hn::StoreU(of_[i], kLanes, to[i].data() + first);
  }

 private:
  Vector of_[kTerms];
};

// A vector of pixels against the model.
struct Compared {
  Vector x, y, r;
  Edge edge;
};

HWY_INLINE Compared compare(const DotPixels& pixels, const LaneModel& model, const Place& place,
                            Vector valid, int i) {
  const Vector x = place.x;
  const Vector y = place.y;
  const Edge edge = edge_at(model, place);
  const Vector plane =
      hn::Add(model.background, hn::Add(hn::Mul(model.per_x, x), hn::Mul(model.per_y, y)));
  const Vector expected = hn::Add(plane, hn::Mul(model.contrast, edge.e));
  const Vector grey = hn::LoadU(kLanes, pixels.grey.data() + i);
  return {x, y, hn::And(valid, hn::Sub(grey, expected)), edge};
}

template <class Sums>
HWY_INLINE void add_common(const Compared& at, Sums& sums) {
  sums.add(ResidualSums::kR, at.r);
  sums.add(ResidualSums::kRx, hn::Mul(at.r, at.x));
  sums.add(ResidualSums::kRy, hn::Mul(at.r, at.y));
  sums.add(ResidualSums::kRe, hn::Mul(at.r, at.edge.e));
}

template <class Sums>
HWY_INLINE void add_common_edge(const Compared& at, Sums& sums) {
  const Vector rw = hn::Mul(at.r, at.edge.w);
  const Vector rwx = hn::Mul(rw, at.x);
  const Vector rwy = hn::Mul(rw, at.y);
  sums.add(ResidualSums::kRwx, rwx);
  sums.add(ResidualSums::kRwy, rwy);
  sums.add(ResidualSums::kRwxx, hn::Mul(rwx, at.x));
  sums.add(ResidualSums::kRwxy, hn::Mul(rwx, at.y));
  sums.add(ResidualSums::kRwyy, hn::Mul(rwy, at.y));
  sums.add(ResidualSums::kRpz, hn::Mul(at.r, at.edge.pz));
}

template <class Sums>
HWY_INLINE void add_failing(const Compared& at, Sums& sums) {
  const Vector re = hn::Mul(at.r, at.edge.e);
  sums.add(ResidualSums::kRex, hn::Mul(re, at.x));
  sums.add(ResidualSums::kRey, hn::Mul(re, at.y));
  sums.add(ResidualSums::kRr, hn::Mul(at.r, at.r));
  sums.add(ResidualSums::kRre, hn::Mul(at.r, re));
}

template <class Sums>
HWY_INLINE void add_failing_edge(const Compared& at, Sums& sums) {
  const Vector rw = hn::Mul(at.r, at.edge.w);
  const Vector xx = hn::Mul(hn::Mul(rw, at.x), at.x);
  const Vector yy = hn::Mul(hn::Mul(rw, at.y), at.y);
  const Vector three = all(3.0);
  sums.add(ResidualSums::kRw3c, hn::Mul(hn::Sub(xx, hn::Mul(three, yy)), at.x));
  sums.add(ResidualSums::kRw3s, hn::Mul(hn::Sub(hn::Mul(three, xx), yy), at.y));
  sums.add(ResidualSums::kRrp, hn::Mul(at.r, hn::Mul(at.r, at.edge.p)));
}

template <class Sums>
HWY_INLINE void add_derivatives(const Compared& at, Sums& sums) {
  const Vector ee = hn::Mul(at.edge.e, at.edge.e);
  const Vector eex = hn::Mul(ee, at.x);
  sums.add(DerivativeSums::kEe, ee);
  sums.add(DerivativeSums::kE, at.edge.e);
  sums.add(DerivativeSums::kEexx, hn::Mul(eex, at.x));
  sums.add(DerivativeSums::kEexy, hn::Mul(eex, at.y));
  sums.add(DerivativeSums::kEeyy, hn::Mul(hn::Mul(ee, at.y), at.y));
}

template <class Sums>
HWY_INLINE void add_derivatives_edge(const Compared& at, Sums& sums) {
  using Term = DerivativeSums;
  const Vector e = at.edge.e;
  const Vector pz = at.edge.pz;
  const Vector wx = hn::Mul(at.edge.w, at.x);
  const Vector wy = hn::Mul(at.edge.w, at.y);
  const Vector wxx = hn::Mul(wx, at.x);
  const Vector wxy = hn::Mul(wx, at.y);
  const Vector wyy = hn::Mul(wy, at.y);
  sums.add(Term::kWxxxx, hn::Mul(wxx, wxx));
  sums.add(Term::kWxxxy, hn::Mul(wxx, wxy));
  sums.add(Term::kWxxyy, hn::Mul(wxy, wxy));
  sums.add(Term::kWxyyy, hn::Mul(wxy, wyy));
  sums.add(Term::kWyyyy, hn::Mul(wyy, wyy));
  sums.add(Term::kWwxx, hn::Mul(wx, wx));
  sums.add(Term::kWwxy, hn::Mul(wx, wy));
  sums.add(Term::kWwyy, hn::Mul(wy, wy));
  sums.add(Term::kWxx, wxx);
  sums.add(Term::kWxy, wxy);
  sums.add(Term::kWyy, wyy);
  sums.add(Term::kEwxx, hn::Mul(e, wxx));
  sums.add(Term::kEwxy, hn::Mul(e, wxy));
  sums.add(Term::kEwyy, hn::Mul(e, wyy));
  sums.add(Term::kPzwxx, hn::Mul(pz, wxx));
  sums.add(Term::kPzwxy, hn::Mul(pz, wxy));
  sums.add(Term::kPzwyy, hn::Mul(pz, wyy));
  sums.add(Term::kPzpz, hn::Mul(pz, pz));
  sums.add(Term::kPze, hn::Mul(pz, e));
  sums.add(Term::kPz, pz);
}

// Calls add with every vector of pixels that begins at lane `part` of its block.
template <class Add>
HWY_INLINE void compare_all(const DotPixels& pixels, const LaneModel& model, int part, Add add) {
  Places places;
  const int count = pixels.count;
  const int last = count + part;
  // All of a block's lanes count, or those of the last block.
  std::array<std::array<float, kBlock>, 2> valid;
  const Vector zero = hn::Zero(kLanes);
  const int last_block = part + (count - 1) / kBlock * kBlock;
  const Vector end = hn::Set(kLanes, static_cast<float>(count));
  hn::StoreU(hn::VecFromMask(kLanes, hn::Eq(zero, zero)), kLanes, valid[0].data());
  hn::StoreU(hn::VecFromMask(kLanes, hn::Lt(hn::Iota(kLanes, static_cast<float>(last_block)), end)),
             kLanes, valid[1].data());
  for (int first = part; first < last; first += Places::kBlocks * kBlock) {
    const int end_of_some = std::min(first + Places::kBlocks * kBlock, last);
    places.set(pixels, model, first, end_of_some);
    int block = 0;
    for (int i = first; i < end_of_some; i += kBlock) {
      const Vector which = hn::LoadU(kLanes, valid[i == last_block ? 1 : 0].data());
      add(compare(pixels, model, places[block++], which, i));
    }
  }
}

template <std::size_t kTerms>
HWY_INLINE void close(SumLanes<kTerms>& lanes) {
  for (std::size_t i = kTerms; i < lanes.size(); ++i) lanes[i].fill(0.0F);
}

struct AllSums {
  HWY_INLINE void operator()(const Compared& at) const {
    add_common(at, sums);
    add_failing(at, sums);
    if (!at.edge.any) return;
    add_common_edge(at, sums);
    add_failing_edge(at, sums);
  }
  LaneSums<ResidualSums::kTerms>& sums;
};

void sum_all(const DotPixels& pixels, const OutlineModel& of, ResidualSums& residuals) {
  const LaneModel model(of);
  SumLanes<ResidualSums::kTerms> lanes;
  close<ResidualSums::kTerms>(lanes);
  for (int part = 0; part < kBlock; part += kStep) {
    LaneSums<ResidualSums::kTerms> sums;
    compare_all(pixels, model, part, AllSums{sums});
    sums.store(part, lanes);
  }
  total<ResidualSums::kTerms>(lanes, residuals.of.data());
}

struct BothSums {
  HWY_INLINE void operator()(const Compared& at) const {
    add_common(at, residuals);
    add_derivatives(at, derivatives);
    if (!at.edge.any) return;
    add_common_edge(at, residuals);
    add_derivatives_edge(at, derivatives);
  }
  LaneSums<ResidualSums::kCommon>& residuals;
  LaneSums<DerivativeSums::kTerms>& derivatives;
};

void sum_both(const DotPixels& pixels, const OutlineModel& of, ResidualSums& residuals,
              DerivativeSums& derivatives) {
  const LaneModel model(of);
  SumLanes<ResidualSums::kCommon> lanes;
  SumLanes<DerivativeSums::kTerms> derivative_lanes;
  close<ResidualSums::kCommon>(lanes);
  close<DerivativeSums::kTerms>(derivative_lanes);
  for (int part = 0; part < kBlock; part += kStep) {
    LaneSums<ResidualSums::kCommon> sums;
    LaneSums<DerivativeSums::kTerms> derivative_sums;
    compare_all(pixels, model, part, BothSums{sums, derivative_sums});
    sums.store(part, lanes);
    derivative_sums.store(part, derivative_lanes);
  }
  total<ResidualSums::kCommon>(lanes, residuals.of.data());
  total<DerivativeSums::kTerms>(derivative_lanes, derivatives.of.data());
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(sum_all);
HWY_EXPORT(sum_both);

void sum_residuals(const DotPixels& pixels, const OutlineModel& model, ResidualSums& residuals) {
  HWY_DYNAMIC_DISPATCH(sum_all)(pixels, model, residuals);
}

void sum_derivatives(const DotPixels& pixels, const OutlineModel& model, ResidualSums& residuals,
                     DerivativeSums& derivatives) {
  HWY_DYNAMIC_DISPATCH(sum_both)(pixels, model, residuals, derivatives);
}

}  // namespace dottrack::image
#endif
