#include "host_sim/renderer/sim_camera.h"

#include <Eigen/Geometry>
#include <cmath>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kWidestTangent = 8.0;  // 83 degrees off the axis: no rectilinear lens sees more

// d(t')/dt of t' = t (1 + r0 + r1 t^2 + r2 t^4).
double stretch_slope(const std::array<double, 3>& r, double t) {
  const double q = t * t;
  return 1.0 + r[0] + 3.0 * r[1] * q + 5.0 * r[2] * q * q;
}

double stretched(const std::array<double, 3>& r, double t) {
  const double q = t * t;
  return t * (1.0 + r[0] + r[1] * q + r[2] * q * q);
}

// The smallest positive t at which the slope vanishes, by the quadratic in t^2.
double one_to_one_limit(const std::array<double, 3>& r) {
  const double a = 5.0 * r[2];
  const double b = 3.0 * r[1];
  const double c = 1.0 + r[0];
  if (c <= 0.0) return 0.0;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return kWidestTangent;
  const double half = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * std::sqrt(discriminant));
  double limit = kWidestTangent * kWidestTangent;
  for (const double q : {a != 0.0 ? half / a : -1.0, half != 0.0 ? c / half : -1.0}) {
    if (q > 0.0 && q < limit) limit = q;
  }
  return std::sqrt(limit);
}

// Solves stretched(t) = t_seen; both grow together up to t_max. Newton, held inside the bracket.
double unstretched(const std::array<double, 3>& r, double t_seen, double t_max) {
  double low = 0.0;
  double high = t_max;
  double t = t_seen < t_max ? t_seen : 0.5 * t_max;
  for (int i = 0; i < 60; ++i) {
    const double excess = stretched(r, t) - t_seen;
    if (excess == 0.0) return t;
    (excess > 0.0 ? high : low) = t;
    const double slope = stretch_slope(r, t);
    double next = slope > 0.0 ? t - excess / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - t) <= 1e-16 + 1e-15 * t) return next;
    t = next;
  }
  return t;
}

}  // namespace

SimCamera::SimCamera(const Eigen::Vector3d& centre_m, const Eigen::Matrix3d& rotation,
                     const Lens& lens, int width_px, int height_px)
    : centre_m_(centre_m),
      rotation_(rotation),
      lens_(lens),
      width_px_(width_px),
      height_px_(height_px),
      max_tangent_(one_to_one_limit(lens.radial)) {
  lens_.axis.normalize();
}

std::optional<Eigen::Vector2d> SimCamera::project(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = rotation_ * (p_world - centre_m_);
  const double along = p.dot(lens_.axis);
  if (!(along > 0.0)) return std::nullopt;
  const Eigen::Vector3d across = p - along * lens_.axis;
  const double t = across.norm() / along;
  if (!(t < max_tangent_)) return std::nullopt;
  const double factor = t > 0.0 ? stretched(lens_.radial, t) / t : 1.0;
  const Eigen::Vector3d bent = along * lens_.axis + factor * across;
  if (!(bent.z() > 0.0)) return std::nullopt;
  const double x = bent.x() / bent.z();
  const double y = bent.y() / bent.z();
  return Eigen::Vector2d(lens_.focal_x_px * x + lens_.skew_px * y + lens_.centre_x_px,
                         lens_.focal_y_px * y + lens_.centre_y_px);
}

std::optional<Eigen::Vector3d> SimCamera::direction(const Eigen::Vector2d& pixel) const {
  const double y = (pixel.y() - lens_.centre_y_px) / lens_.focal_y_px;
  const double x = (pixel.x() - lens_.centre_x_px - lens_.skew_px * y) / lens_.focal_x_px;
  const Eigen::Vector3d bent(x, y, 1.0);
  const double along = bent.dot(lens_.axis);
  if (!(along > 0.0)) return std::nullopt;
  const Eigen::Vector3d across = bent - along * lens_.axis;
  const double t_seen = across.norm() / along;
  if (!(t_seen < stretched(lens_.radial, max_tangent_))) return std::nullopt;
  if (t_seen == 0.0) return Eigen::Vector3d(rotation_.transpose() * bent);
  const double t = unstretched(lens_.radial, t_seen, max_tangent_);
  return Eigen::Vector3d(rotation_.transpose() * (along * lens_.axis + (t / t_seen) * across));
}

Eigen::Matrix3d looking_at(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& aim_m,
                           double roll_rad, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = (aim_m - centre_m).normalized();
  const Eigen::Vector3d level = z.cross(up).normalized();
  const Eigen::Vector3d down = z.cross(level);
  const double c = cosine(roll_rad);
  const double s = sine(roll_rad);
  Eigen::Matrix3d rotation;
  rotation.row(0) = (c * level + s * down).transpose();
  rotation.row(1) = (c * down - s * level).transpose();
  rotation.row(2) = z.transpose();
  return rotation;
}

}  // namespace dottrack::host_sim
