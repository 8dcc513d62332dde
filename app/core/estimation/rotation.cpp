#include "app/core/estimation/rotation.h"

#include <cmath>

namespace dottrack::estimation {
namespace {

constexpr double kSmallAngle_rad = 1e-4;  // below it, series to the second order are exact enough

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

Eigen::Quaterniond turn_by(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  const double part =
      angle < kSmallAngle_rad ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond turn;
  turn.w() = std::cos(0.5 * angle);
  turn.vec() = part * vector_rad;
  return turn;
}

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d part = sign * rotation.vec();
  const double sine = part.norm();
  const double half_angle = std::atan2(sine, sign * rotation.w());
  return sine > 0.0 ? Eigen::Vector3d(2.0 * half_angle / sine * part) : Eigen::Vector3d::Zero();
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  const Eigen::Matrix3d cross = cross_matrix(vector_rad);
  const bool small = angle < kSmallAngle_rad;
  const double square = angle * angle;
  const double first = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double second =
      small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
  return Eigen::Matrix3d::Identity() + first * cross + second * (cross * cross);
}

}  // namespace dottrack::estimation
