#include "app/core/geometry/pixel_bundle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/geometry/pixel_bundle.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

#include "app/core/geometry/image_plane.h"

HWY_BEFORE_NAMESPACE();
namespace dottrack::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;

// A Newton step below this leaves an error of its square: under double precision.
constexpr double kLastStep = 1e-9;
constexpr int kMostSteps = 8;
// Of the cosine to the image plane's normal and to the optical axis: what is less goes the careful
// way.
constexpr double kLeastCosine = 1e-6;

HWY_INLINE Vector all(double value) {
  return hn::Set(Lanes(), value);
}

// The constructors are spelled out: those of the compiler's making would be built for another
// processor.
struct Axis {
  HWY_INLINE Axis() {}
  HWY_INLINE explicit Axis(const Eigen::Vector3d& v)
      : x(all(v.x())), y(all(v.y())), z(all(v.z())) {}
  HWY_INLINE Axis(Vector vx, Vector vy, Vector vz) : x(vx), y(vy), z(vz) {}
  Vector x, y, z;
};

HWY_INLINE Axis operator+(const Axis& a, const Axis& b) {
  return Axis(hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z));
}

HWY_INLINE Axis operator-(const Axis& a, const Axis& b) {
  return Axis(hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z));
}

HWY_INLINE Axis operator*(Vector s, const Axis& a) {
  return Axis(hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z));
}

HWY_INLINE Vector dot(const Axis& a, const Axis& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE void store(const Axis& a, PixelBundle::Axes& to, std::size_t i) {
  hn::Store(a.x, Lanes(), &to[0][i]);
  hn::Store(a.y, Lanes(), &to[1][i]);
  hn::Store(a.z, Lanes(), &to[2][i]);
}

HWY_INLINE Axis load(const PixelBundle::Axes& from, std::size_t i) {
  const Lanes lanes;
  return Axis(hn::Load(lanes, &from[0][i]), hn::Load(lanes, &from[1][i]),
              hn::Load(lanes, &from[2][i]));
}

struct Model {
  HWY_INLINE explicit Model(const Cahvor& m)
      : a(m.a), h(m.h), v(m.v), o(m.o), r0(all(m.r.x())), r1(all(m.r.y())), r2(all(m.r.z())) {
    const PlaneDirection corner = through_pixel(m, Eigen::Vector2d::Zero());
    const Eigen::Matrix<double, 3, 2> slope = plane_jacobian(m, corner.sign);
    at_zero = Axis(corner.direction);
    by_x = Axis(slope.col(0));
    by_y = Axis(slope.col(1));
  }
  Axis a, h, v, o;
  Axis at_zero, by_x, by_y;  // direction before distortion is undone: it is linear in the pixel
  Vector r0, r1, r2;
};

// What lies between the steps of a bundle, side by side.
struct Bending {
  alignas(64) PixelBundle::Numbers tau;
  alignas(64) PixelBundle::Numbers u;  // 0: unknown
  alignas(64) PixelBundle::Numbers w;
  alignas(64) PixelBundle::Numbers ahead;
  alignas(64) PixelBundle::Axes l;
};

// Newton steps wait for each other: so many vectors take theirs in turns.
constexpr std::size_t kTogether = 4;
static_assert(PixelBundle::kCapacity % (kTogether * hn::MaxLanes(Lanes())) == 0);

struct Equation {
  HWY_INLINE Equation() {}
  HWY_INLINE Equation(const Model& m, Vector tau) {
    const Vector one = all(1.0);
    a = hn::Add(one, m.r0);
    b = hn::Mul(m.r1, tau);
    c = hn::Mul(m.r2, hn::Mul(tau, tau));
    const Vector grown = hn::Add(a, hn::Add(b, c));
    u = hn::IfThenElse(hn::Gt(grown, all(0.5)), hn::Div(one, grown), one);
    b3 = hn::Mul(all(3.0), b);
    c5 = hn::Mul(all(5.0), c);
    settled = hn::Lt(tau, tau);
    rising = hn::Gt(a, all(0.0));
  }

  HWY_INLINE Vector slope() const {
    const Vector u2 = hn::Mul(u, u);
    return hn::Add(a, hn::Mul(u2, hn::Add(b3, hn::Mul(u2, c5))));
  }

  // A lane that has settled stays as it is.
  HWY_INLINE void take_step() {
    const Vector u2 = hn::Mul(u, u);
    const Vector down = slope();
    const Vector value = hn::Mul(u, hn::Add(a, hn::Mul(u2, hn::Add(b, hn::Mul(u2, c)))));
    const Vector step = hn::Div(hn::Sub(value, all(1.0)), down);
    const Vector next = hn::Sub(u, step);
    rising = hn::And(rising, hn::Or(settled, hn::Gt(down, all(0.0))));
    u = hn::IfThenElse(settled, u, next);
    settled = hn::Or(settled, hn::Le(hn::Abs(step), hn::Mul(all(kLastStep), hn::Abs(next))));
  }

  // u, or 0 where the lens bends so much that its image may fold.
  HWY_INLINE Vector solution() const {
    const Vector u2 = hn::Mul(u, u);
    const Mask dips = hn::And(hn::Lt(b, all(0.0)),
                              hn::Gt(hn::Mul(all(10.0), hn::Mul(c, u2)), hn::Mul(all(-3.0), b)));
    const Mask known =
        hn::And(hn::And(settled, rising),
                hn::AndNot(dips, hn::And(hn::Gt(slope(), all(0.0)), hn::Gt(u, all(0.0)))));
    return hn::IfThenElseZero(known, u);
  }

  Vector a, b, c, b3, c5, u;
  Mask settled, rising;
};

// u with u (1 + r0) + b u^3 + c u^5 = 1, from where a lens of little distortion has it.
HWY_INLINE void shrink(const Model& m, Bending& bending, std::size_t from) {
  const Lanes lanes;
  Equation equations[kTogether];
  for (std::size_t k = 0; k < kTogether; ++k) {
    equations[k] = Equation(m, hn::Load(lanes, &bending.tau[from + k * hn::Lanes(lanes)]));
  }
  Mask settled = equations[0].settled;
  for (int i = 0; i < kMostSteps && !hn::AllTrue(lanes, settled); ++i) {
    for (Equation& equation : equations) equation.take_step();
    settled = equations[0].settled;
    for (const Equation& equation : equations) settled = hn::And(settled, equation.settled);
  }
  for (std::size_t k = 0; k < kTogether; ++k) {
    hn::Store(equations[k].solution(), lanes, &bending.u[from + k * hn::Lanes(lanes)]);
  }
}

// CAHVOR's derivatives at a distance of one from the centre, as `project` has them.
HWY_INLINE Mask differentiate(const Model& m, const Axis& d, Vector px, Vector py, Axis& x_per_rad,
                              Axis& y_per_rad) {
  const Vector one = all(1.0);
  const Vector w = dot(d, m.o);
  const Vector per_w = hn::Div(one, w);
  const Axis l = d - w * m.o;
  const Vector tau = hn::Mul(dot(l, l), hn::Mul(per_w, per_w));
  const Vector mu = hn::Add(m.r0, hn::Mul(tau, hn::Add(m.r1, hn::Mul(tau, m.r2))));
  const Axis bent = d + mu * l;
  const Vector range = dot(bent, m.a);
  const Vector per_range = hn::Div(one, range);
  const Axis across = l - dot(l, m.o) * m.o;
  const Vector slope = hn::Add(m.r1, hn::Mul(hn::Add(tau, tau), m.r2));
  const Axis dmu = hn::Mul(hn::Add(slope, slope), per_w) * (per_w * across - tau * m.o);
  const auto back = [&](const Axis& n) HWY_ATTR {
    return hn::Add(one, mu) * n - hn::Mul(mu, dot(n, m.o)) * m.o + dot(n, l) * dmu;
  };
  x_per_rad = back(per_range * (m.h - px * m.a));
  y_per_rad = back(per_range * (m.v - py * m.a));
  const Vector least = all(kLeastCosine);
  return hn::And(hn::And(hn::Gt(w, least), hn::Gt(range, least)), hn::Gt(dot(d, m.a), least));
}

HWY_INLINE void bend(const Model& m, const PixelBundle& bundle, std::size_t i, Bending& bending) {
  const Lanes lanes;
  const Vector px = hn::Load(lanes, &bundle.x[i]);
  const Vector py = hn::Load(lanes, &bundle.y[i]);
  const Axis g = m.at_zero + px * m.by_x + py * m.by_y;
  const Vector w = dot(g, m.o);
  const Axis l = g - w * m.o;
  hn::Store(hn::Div(dot(l, l), hn::Mul(w, w)), lanes, &bending.tau[i]);
  hn::Store(w, lanes, &bending.w[i]);
  hn::Store(dot(g, m.a), lanes, &bending.ahead[i]);
  store(l, bending.l, i);
}

HWY_INLINE void unbend(const Model& m, const Bending& bending, std::size_t i, PixelBundle& bundle) {
  const Lanes lanes;
  const Vector w = hn::Load(lanes, &bending.w[i]);
  const Vector u = hn::Load(lanes, &bending.u[i]);
  const Vector zero = hn::Zero(lanes);
  Mask known = hn::And(hn::Gt(w, zero), hn::Gt(hn::Load(lanes, &bending.ahead[i]), zero));
  known = hn::And(known, hn::Gt(u, zero));
  const Axis along = w * m.o + u * load(bending.l, i);
  const Axis d = hn::Div(all(1.0), hn::Sqrt(dot(along, along))) * along;
  Axis x_per_rad;
  Axis y_per_rad;
  known = hn::And(known, differentiate(m, d, hn::Load(lanes, &bundle.x[i]),
                                       hn::Load(lanes, &bundle.y[i]), x_per_rad, y_per_rad));
  store(d, bundle.direction, i);
  store(x_per_rad, bundle.x_per_rad, i);
  store(y_per_rad, bundle.y_per_rad, i);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(lanes, known, bits);
  const unsigned known_bits = bits[0];
  for (std::size_t k = 0; k < hn::Lanes(lanes); ++k) {
    bundle.known[i + k] = static_cast<std::uint8_t>((known_bits >> k) & 1U);
  }
}

void unproject_all(const Cahvor& cahvor, PixelBundle& bundle) {
  const std::size_t step = hn::Lanes(Lanes());
  const Model m(cahvor);
  Bending bending;
  for (std::size_t from = 0; from < bundle.size; from += kTogether * step) {
    for (std::size_t k = 0; k < kTogether; ++k) bend(m, bundle, from + k * step, bending);
    shrink(m, bending, from);
    for (std::size_t k = 0; k < kTogether; ++k) unbend(m, bending, from + k * step, bundle);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::geometry {

HWY_EXPORT(unproject_all);

void unproject_bundle(const CameraModel& model, PixelBundle& bundle) noexcept {
  Cahvor cahvor;
  if (!as_cahvor(model, cahvor)) {
    bundle.known.fill(0);
    return;
  }
  HWY_DYNAMIC_DISPATCH(unproject_all)(cahvor, bundle);
}

}  // namespace dottrack::geometry
#endif
