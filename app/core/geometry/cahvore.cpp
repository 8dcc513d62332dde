#include "app/core/geometry/cahvore.h"

#include <cmath>
#include <numbers>

#include "app/core/geometry/image_plane.h"
#include "app/core/geometry/radial.h"
#include "app/core/geometry/refusal.h"

namespace dottrack::geometry {
namespace {

constexpr double kLinearityZero = 1e-15;  // |L| up to this is a fish-eye
constexpr double kOnAxisTangent = 1e-12;  // so close to the axis that the direction across is noise
constexpr double kNearAxisTangent = 1e-8;  // so close that a ray is as long as O is
constexpr double kLastStep_rad = 1e-9;     // Newton squares it: under double precision
constexpr int kMostSteps = 50;

struct ValueSlope {
  double value;
  double slope;
};

// chi and d(chi)/d(theta).
ValueSlope chi_of(double theta, double linearity) noexcept {
  const double t = linearity * theta;
  if (linearity > kLinearityZero) {
    const double tangent = std::tan(t);
    return {tangent / linearity, 1.0 + tangent * tangent};
  }
  if (linearity < -kLinearityZero) return {std::sin(t) / linearity, std::cos(t)};
  return {theta, 1.0};
}

// theta and d(theta)/d(chi); NaN past the reach of the arc sine.
ValueSlope theta_of(double chi, double linearity) noexcept {
  const double t = linearity * chi;
  if (linearity > kLinearityZero) return {std::atan(t) / linearity, 1.0 / (1.0 + t * t)};
  if (linearity < -kLinearityZero) {
    return {std::asin(t) / linearity, 1.0 / std::sqrt(1.0 - t * t)};
  }
  return {chi, 1.0};
}

bool lens_reaches(double theta, double linearity) noexcept {
  return theta >= 0.0 && theta <= kWidestHalfAngle_rad &&
         theta * std::abs(linearity) < 0.5 * std::numbers::pi - 1e-15;
}

// E(theta) and its derivative, metres.
ValueSlope pupil(const Eigen::Vector3d& e, double theta) noexcept {
  const double t2 = theta * theta;
  return {e.x() + t2 * (e.y() + t2 * e.z()), 2.0 * theta * (e.y() + 2.0 * t2 * e.z())};
}

RadialPolynomial radial(const Cahvore& m) noexcept {
  return {1.0 + m.r.x(), m.r.y(), m.r.z()};
}

// A point split by the optical axis.
struct Split {
  Eigen::Vector3d lambda;  // across the axis, metres
  double length;           // |lambda|
  double zeta;             // along the axis, metres
};

// The angle at which a point's light enters, and the slope of the equation there.
struct Entry {
  double theta;
  double slope;
};

OpticsStatus solve_entry(const Cahvore& m, const Split& s, Entry& entry) noexcept {
  double theta = std::atan2(s.length, s.zeta);
  for (int i = 0; i < kMostSteps; ++i) {
    const double sine = std::sin(theta);
    const double cosine = std::cos(theta);
    const ValueSlope e = pupil(m.e, theta);
    const double excess = s.zeta * sine - s.length * cosine - (theta - sine) * e.value;
    const double slope =
        s.zeta * cosine + s.length * sine - (1.0 - cosine) * e.value - (theta - sine) * e.slope;
    if (!(slope > 0.0)) return OpticsStatus::not_converged;
    const double step = excess / slope;
    theta -= step;
    if (std::abs(step) < kLastStep_rad) {
      entry = {theta, slope};
      return OpticsStatus::ok;
    }
  }
  return OpticsStatus::not_converged;
}

// Everything between a point and its pixel.
struct Distorted {
  Split split;
  Entry entry;
  double rho_slope;       // d(rho)/d(theta)
  double gain;            // rho / |lambda|, 1 a metre
  Eigen::Vector3d point;  // d' = O + gain lambda
  double range;           // d'.A
  bool on_axis;
};

OpticsStatus bend(const Cahvore& m, Distorted& f) noexcept {
  const RadialPolynomial polynomial = radial(m);
  if (f.on_axis) {
    f.gain = polynomial.a / f.split.zeta;
    return polynomial.a > 0.0 ? OpticsStatus::ok : OpticsStatus::outside_domain;
  }
  const OpticsStatus status = solve_entry(m, f.split, f.entry);
  if (status != OpticsStatus::ok) return status;
  if (!lens_reaches(f.entry.theta, m.linearity)) return OpticsStatus::outside_domain;
  const ValueSlope chi = chi_of(f.entry.theta, m.linearity);
  if (!polynomial.rises_to_square(chi.value * chi.value)) return OpticsStatus::outside_domain;
  f.rho_slope = polynomial.slope(chi.value) * chi.slope;
  f.gain = polynomial.value(chi.value) / f.split.length;
  return OpticsStatus::ok;
}

OpticsStatus distort(const Cahvore& m, const Eigen::Vector3d& d, Distorted& f) noexcept {
  f.split.zeta = d.dot(m.o);
  f.split.lambda = d - f.split.zeta * m.o;
  f.split.length = f.split.lambda.norm();
  f.on_axis = f.split.length <= kOnAxisTangent * std::abs(f.split.zeta);
  const bool backwards = !clearly_in_front(f.split.zeta, d.squaredNorm());
  const OpticsStatus refused = backwards ? OpticsStatus::behind : OpticsStatus::outside_domain;
  const bool usable = d.squaredNorm() > kCentreRadiusSquared_m2;
  if (!usable || (f.on_axis && backwards)) return refuse_point(d, OpticsStatus::behind);
  const OpticsStatus status = bend(m, f);
  if (status == OpticsStatus::outside_domain || (status != OpticsStatus::ok && backwards)) {
    return refuse_point(d, refused);
  }
  if (status != OpticsStatus::ok) return refuse_point(d, status);
  f.point = m.o + f.gain * f.split.lambda;
  f.range = f.point.dot(m.a);
  return f.range > 0.0 ? OpticsStatus::ok : refuse_point(d, refused);
}

// d(gain lambda) along n, less the part that lambda itself brings: by the point, 1 a metre.
Eigen::Vector3d gradient_of_gain(const Cahvore& m, const Distorted& f) {
  if (f.on_axis) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d across = f.split.lambda / f.split.length;
  const Eigen::Vector3d dlength = across - across.dot(m.o) * m.o;
  const Eigen::Vector3d dtheta =
      (std::cos(f.entry.theta) * dlength - std::sin(f.entry.theta) * m.o) / f.entry.slope;
  return (f.rho_slope * dtheta - f.gain * dlength) / f.split.length;
}

Eigen::RowVector3d back_through_lens(const Cahvore& m, const Distorted& f,
                                     const Eigen::Vector3d& dgain, const Eigen::Vector3d& n) {
  return (f.gain * (n - n.dot(m.o) * m.o) + n.dot(f.split.lambda) * dgain).transpose();
}

}  // namespace

OpticsStatus project(const Cahvore& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian) noexcept {
  Distorted f;
  const OpticsStatus status = distort(model, p_world - model.c, f);
  if (status != OpticsStatus::ok) return status;
  const double x = f.point.dot(model.h) / f.range;
  const double y = f.point.dot(model.v) / f.range;
  if (!std::isfinite(x + y)) return OpticsStatus::not_finite;
  pixel = {x, y};
  if (jacobian != nullptr) {
    const Eigen::Vector3d dgain = gradient_of_gain(model, f);
    jacobian->row(0) = back_through_lens(model, f, dgain, (model.h - x * model.a) / f.range);
    jacobian->row(1) = back_through_lens(model, f, dgain, (model.v - y * model.a) / f.range);
  }
  return OpticsStatus::ok;
}

namespace {

// theta / sin(theta) - 1 and its derivative: how far the pupil has moved, in units of E.
ValueSlope pupil_shift(double theta) noexcept {
  if (theta < 0.03) {  // the series: the closed form's derivative loses its digits to cancellation
    const double t2 = theta * theta;
    return {t2 * (1.0 / 6.0 + t2 * (7.0 / 360.0 + t2 * (31.0 / 15120.0))),
            theta * (1.0 / 3.0 + t2 * (7.0 / 90.0 + t2 * (31.0 / 2520.0)))};
  }
  const double sine = std::sin(theta);
  return {theta / sine - 1.0, (sine - theta * std::cos(theta)) / (sine * sine)};
}

// Everything between a pixel and its ray.
struct Undistorted {
  PlaneDirection plane;
  Split split;       // of the plane's direction
  double tangent;    // chi', the distorted radius
  double chi_slope;  // d(chi)/d(chi')
  ValueSlope theta;  // and d(theta)/d(chi)
};

OpticsStatus undistort(const Cahvore& m, const Eigen::Vector2d& pixel, Undistorted& f) noexcept {
  f.plane = through_pixel(m, pixel);
  const Eigen::Vector3d& g = f.plane.direction;
  f.split.zeta = g.dot(m.o);
  if (!(g.dot(m.a) > 0.0) || !(f.split.zeta > 0.0)) return refuse_pixel(pixel);
  f.split.lambda = g - f.split.zeta * m.o;
  f.split.length = f.split.lambda.norm();
  f.tangent = f.split.length / f.split.zeta;
  if (!std::isfinite(f.tangent)) return OpticsStatus::not_finite;
  const RadialPolynomial polynomial = radial(m);
  double chi = 0.0;
  const OpticsStatus status = invert(polynomial, f.tangent, f.tangent, chi);
  if (status != OpticsStatus::ok) return status;
  f.chi_slope = 1.0 / polynomial.slope(chi);
  f.theta = theta_of(chi, m.linearity);
  return lens_reaches(f.theta.value, m.linearity) ? OpticsStatus::ok : OpticsStatus::outside_domain;
}

// u = cos(theta) O + (sin(theta) / |lambda|) lambda; on the axis the ratio is its limit.
struct Bearing {
  double sine;
  double cosine;
  double ratio;            // sin(theta) / |lambda|
  Eigen::Vector3d across;  // lambda / |lambda|; zero on the axis, where it means nothing
};

Bearing bearing(const Undistorted& f) {
  const double sine = std::sin(f.theta.value);
  const double cosine = std::cos(f.theta.value);
  if (f.tangent > kOnAxisTangent) {
    return {sine, cosine, sine / f.split.length, f.split.lambda / f.split.length};
  }
  return {sine, cosine, f.theta.slope * f.chi_slope / f.split.zeta, Eigen::Vector3d::Zero()};
}

// Where |O| is not quite 1 lambda has a part along O, and on the axis it has no other.
Eigen::Vector3d across(const Cahvore& m, const Undistorted& f) {
  if (f.tangent > kNearAxisTangent) return f.split.lambda;
  return f.split.lambda - (f.split.lambda.dot(m.o) / m.o.squaredNorm()) * m.o;
}

void fill_jacobian(const Cahvore& m, const Undistorted& f, const Bearing& b, RayJacobian& out) {
  const ValueSlope shift = pupil_shift(f.theta.value);
  const ValueSlope e = pupil(m.e, f.theta.value);
  const double dorigin = shift.slope * e.value + shift.value * e.slope;
  const Eigen::Matrix<double, 3, 2> dplane = plane_jacobian(m, f.plane.sign);
  for (int i = 0; i < 2; ++i) {
    const double dzeta = dplane.col(i).dot(m.o);
    const Eigen::Vector3d dlambda = dplane.col(i) - dzeta * m.o;
    const double dlength = b.across.dot(dlambda);
    const double dtheta =
        f.theta.slope * f.chi_slope * (dlength - f.tangent * dzeta) / f.split.zeta;
    out.origin.col(i) = (dorigin * dtheta) * m.o;
    out.direction.col(i) =
        dtheta * (b.cosine * b.across - b.sine * m.o) + b.ratio * (dlambda - dlength * b.across);
  }
}

}  // namespace

OpticsStatus unproject(const Cahvore& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian) noexcept {
  Undistorted f;
  const OpticsStatus status = undistort(model, pixel, f);
  if (status != OpticsStatus::ok) return status;
  const Bearing b = bearing(f);
  const double shift = pupil_shift(f.theta.value).value * pupil(model.e, f.theta.value).value;
  const Eigen::Vector3d origin = model.c + shift * model.o;
  const Eigen::Vector3d direction = b.cosine * model.o + b.ratio * across(model, f);
  if (!(origin + direction).allFinite()) return OpticsStatus::not_finite;
  ray.origin = origin;
  ray.direction = direction;
  if (jacobian != nullptr) fill_jacobian(model, f, b, *jacobian);
  return OpticsStatus::ok;
}

}  // namespace dottrack::geometry
