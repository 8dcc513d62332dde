#include "host_sim/renderer/lens.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kWidestTangent = 8.0;           // 83 degrees: no rectilinear lens sees more
constexpr double kWidestAngle = radians(140.0);  // no fish-eye sees more
constexpr double kNearRightAngle = radians(89.9);

using Polynomial = std::array<double, 3>;

// d(radius)/dc.
double stretch_slope(const Polynomial& r, double c) {
  const double q = c * c;
  return 1.0 + r[0] + 3.0 * r[1] * q + 5.0 * r[2] * q * q;
}

double stretched(const Polynomial& r, double c) {
  const double q = c * c;
  return c * (1.0 + r[0] + r[1] * q + r[2] * q * q);
}

// The smallest positive c below `widest` at which the slope vanishes, by the quadratic in c^2.
double one_to_one_limit(const Polynomial& r, double widest) {
  const double a = 5.0 * r[2];
  const double b = 3.0 * r[1];
  const double c = 1.0 + r[0];
  if (c <= 0.0) return 0.0;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return widest;
  const double half = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * std::sqrt(discriminant));
  double limit = widest * widest;
  for (const double q : {a != 0.0 ? half / a : -1.0, half != 0.0 ? c / half : -1.0}) {
    if (q > 0.0 && q < limit) limit = q;
  }
  return std::sqrt(limit);
}

// Solves stretched(c) = radius; both grow together up to c_max. Newton, held inside the bracket.
double unstretched(const Polynomial& r, double radius, double c_max) {
  double low = 0.0;
  double high = c_max;
  double c = radius < c_max ? radius : 0.5 * c_max;
  for (int i = 0; i < 60; ++i) {
    const double excess = stretched(r, c) - radius;
    if (excess == 0.0) return c;
    (excess > 0.0 ? high : low) = c;
    const double slope = stretch_slope(r, c);
    double next = slope > 0.0 ? c - excess / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - c) <= 1e-16 + 1e-15 * c) return next;
    c = next;
  }
  return c;
}

// a / sin(a) - 1.
double beyond_its_sine(double angle) {
  if (angle < 0.02) {
    const double q = angle * angle;
    return q * (1.0 / 6.0 + q * (7.0 / 360.0 + q * (31.0 / 15120.0)));
  }
  return angle / sine(angle) - 1.0;
}

}  // namespace

LensCurve::LensCurve(const Lens& lens)
    : kind_(lens.kind),
      radial_(lens.kind == LensKind::pinhole ? Polynomial{} : lens.radial),
      linearity_(lens.linearity),
      pupil_m_(lens.pupil_m),
      max_c_(kWidestTangent) {
  if (kind_ == LensKind::fisheye) {
    const double bent = std::abs(linearity_);
    max_c_ = c_of(bent * kWidestAngle < kNearRightAngle ? kWidestAngle : kNearRightAngle / bent);
  }
  max_c_ = one_to_one_limit(radial_, max_c_);
}

double LensCurve::c_of(double angle_rad) const {
  if (linearity_ > 0.0) return tangent(linearity_ * angle_rad) / linearity_;
  return linearity_ < 0.0 ? sine(linearity_ * angle_rad) / linearity_ : angle_rad;
}

double LensCurve::angle_of(double c) const {
  const double bent = linearity_ * c;
  if (linearity_ > 0.0) return arc_tangent(bent, 1.0) / linearity_;
  if (linearity_ < 0.0) {
    return arc_tangent(bent, std::sqrt((1.0 + bent) * (1.0 - bent))) / linearity_;
  }
  return c;
}

double LensCurve::pupil_at(double angle_rad) const {
  const double q = angle_rad * angle_rad;
  return beyond_its_sine(angle_rad) * (pupil_m_[0] + q * (pupil_m_[1] + q * pupil_m_[2]));
}

// The light aims at the pupil, whose place depends on the light's angle: aimed again until it
// hits. Each round brings the error down by the pupil's travel over the distance, so only what is
// within millimetres of the lens is not found.
std::optional<double> LensCurve::entry_angle(double along, double across) const {
  double angle = arc_tangent(across, along);
  for (int round = 0; round < 40; ++round) {
    if (!(angle < kWidestAngle)) return std::nullopt;
    const double next = arc_tangent(across, along - pupil_at(angle));
    if (std::abs(next - angle) <= 2e-15) return next;
    angle = next;
  }
  return std::nullopt;
}

std::optional<double> LensCurve::radius(double along, double across) const {
  double c = 0.0;
  if (kind_ == LensKind::fisheye) {
    const auto angle = along != 0.0 || across != 0.0 ? entry_angle(along, across) : std::nullopt;
    if (!angle || !(*angle * std::abs(linearity_) < kNearRightAngle)) return std::nullopt;
    c = c_of(*angle);
  } else {
    if (!(along > 0.0)) return std::nullopt;
    c = across / along;
  }
  if (!(c < max_c_)) return std::nullopt;
  return stretched(radial_, c);
}

std::optional<LensCurve::Entry> LensCurve::entry(double radius) const {
  if (!(radius < stretched(radial_, max_c_))) return std::nullopt;
  const double c = unstretched(radial_, radius, max_c_);
  if (kind_ != LensKind::fisheye) return Entry{c, 1.0, 0.0};
  const double angle = angle_of(c);
  return Entry{sine(angle), cosine(angle), pupil_at(angle)};
}

}  // namespace dottrack::host_sim
