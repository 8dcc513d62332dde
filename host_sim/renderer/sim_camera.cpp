#include "host_sim/renderer/sim_camera.h"

#include <Eigen/Geometry>
#include <cmath>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

Lens with_unit_axis(Lens lens) {
  lens.axis.normalize();
  return lens;
}

}  // namespace

SimCamera::SimCamera(const Eigen::Vector3d& centre_m, const Eigen::Matrix3d& rotation,
                     const Lens& lens, int width_px, int height_px)
    : centre_m_(centre_m),
      rotation_(rotation),
      lens_(with_unit_axis(lens)),
      curve_(lens),
      width_px_(width_px),
      height_px_(height_px) {}

std::optional<Eigen::Vector2d> SimCamera::project(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = rotation_ * (p_world - centre_m_);
  const double along = p.dot(lens_.axis);
  const Eigen::Vector3d offset = p - along * lens_.axis;
  const double across = offset.norm();
  const auto radius = curve_.radius(along, across);
  if (!radius) return std::nullopt;
  Eigen::Vector3d bent = lens_.axis;
  if (across > 0.0) bent += (*radius / across) * offset;
  if (!(bent.z() > 0.0)) return std::nullopt;
  const double x = bent.x() / bent.z();
  const double y = bent.y() / bent.z();
  return Eigen::Vector2d(lens_.focal_x_px * x + lens_.skew_px * y + lens_.centre_x_px,
                         lens_.focal_y_px * y + lens_.centre_y_px);
}

std::optional<Sight> SimCamera::sight(const Eigen::Vector2d& pixel) const {
  const double y = (pixel.y() - lens_.centre_y_px) / lens_.focal_y_px;
  const double x = (pixel.x() - lens_.centre_x_px - lens_.skew_px * y) / lens_.focal_x_px;
  const Eigen::Vector3d bent(x, y, 1.0);
  const double along = bent.dot(lens_.axis);
  if (!(along > 0.0)) return std::nullopt;
  const Eigen::Vector3d offset = bent - along * lens_.axis;
  const double across = offset.norm();
  const auto entry = curve_.entry(across / along);
  if (!entry) return std::nullopt;
  Eigen::Vector3d direction = entry->cosine * lens_.axis;
  if (across > 0.0) direction += (entry->sine / across) * offset;
  return Sight{centre_m_ + rotation_.transpose() * (entry->pupil_m * lens_.axis),
               rotation_.transpose() * direction};
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

Eigen::Matrix3d turn(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d axis = v / angle;
  Eigen::Matrix3d across;
  across << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d::Identity() + sine(angle) * across +
         (1.0 - cosine(angle)) * across * across;
}

}  // namespace dottrack::host_sim
