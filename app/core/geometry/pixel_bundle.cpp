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

// u with u (1 + r0) + b u^3 + c u^5 = 1, from where a lens of little distortion has it. A lane that
// has settled stays as it is. Unknown where the lens bends so much that its image may fold.
HWY_INLINE Mask shrink(const Model& m, Vector tau, Vector& u) {
  const Vector one = all(1.0);
  const Vector a = hn::Add(one, m.r0);
  const Vector b = hn::Mul(m.r1, tau);
  const Vector c = hn::Mul(m.r2, hn::Mul(tau, tau));
  const Vector grown = hn::Add(a, hn::Add(b, c));
  u = hn::IfThenElse(hn::Gt(grown, all(0.5)), hn::Div(one, grown), one);
  const Vector b3 = hn::Mul(all(3.0), b);
  const Vector c5 = hn::Mul(all(5.0), c);
  Mask settled = hn::Lt(tau, tau);
  Mask rising = hn::Gt(a, all(0.0));
  for (int i = 0; i < kMostSteps && !hn::AllTrue(Lanes(), settled); ++i) {
    const Vector u2 = hn::Mul(u, u);
    const Vector slope = hn::Add(a, hn::Mul(u2, hn::Add(b3, hn::Mul(u2, c5))));
    const Vector value = hn::Mul(u, hn::Add(a, hn::Mul(u2, hn::Add(b, hn::Mul(u2, c)))));
    const Vector step = hn::Div(hn::Sub(value, one), slope);
    const Vector next = hn::Sub(u, step);
    rising = hn::And(rising, hn::Or(settled, hn::Gt(slope, all(0.0))));
    u = hn::IfThenElse(settled, u, next);
    settled = hn::Or(settled, hn::Le(hn::Abs(step), hn::Mul(all(kLastStep), hn::Abs(next))));
  }
  const Vector u2 = hn::Mul(u, u);
  const Vector slope = hn::Add(a, hn::Mul(u2, hn::Add(b3, hn::Mul(u2, c5))));
  const Mask dips = hn::And(hn::Lt(b, all(0.0)),
                            hn::Gt(hn::Mul(all(10.0), hn::Mul(c, u2)), hn::Mul(all(-3.0), b)));
  return hn::And(hn::And(settled, rising),
                 hn::AndNot(dips, hn::And(hn::Gt(slope, all(0.0)), hn::Gt(u, all(0.0)))));
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

void unproject_all(const Cahvor& cahvor, PixelBundle& bundle) {
  const Lanes lanes;
  const Model m(cahvor);
  for (std::size_t i = 0; i < bundle.size; i += hn::Lanes(lanes)) {
    const Vector px = hn::Load(lanes, &bundle.x[i]);
    const Vector py = hn::Load(lanes, &bundle.y[i]);
    const Axis g = m.at_zero + px * m.by_x + py * m.by_y;
    const Vector w = dot(g, m.o);
    const Axis l = g - w * m.o;
    const Vector tau = hn::Div(dot(l, l), hn::Mul(w, w));
    Vector u;
    Mask known = hn::And(hn::Gt(w, all(0.0)), hn::Gt(dot(g, m.a), all(0.0)));
    known = hn::And(known, shrink(m, tau, u));
    const Axis along = w * m.o + u * l;
    const Axis d = hn::Div(all(1.0), hn::Sqrt(dot(along, along))) * along;
    Axis x_per_rad;
    Axis y_per_rad;
    known = hn::And(known, differentiate(m, d, px, py, x_per_rad, y_per_rad));
    store(d, bundle.direction, i);
    store(x_per_rad, bundle.x_per_rad, i);
    store(y_per_rad, bundle.y_per_rad, i);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(lanes, known, bits);
    for (std::size_t k = 0; k < hn::Lanes(lanes); ++k) {
      bundle.known[i + k] = static_cast<std::uint8_t>((bits[0] >> k) & 1U);
    }
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
