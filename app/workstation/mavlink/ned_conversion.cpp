#include "app/workstation/mavlink/ned_conversion.h"

#include <cmath>
#include <numbers>

namespace dottrack::workstation {
namespace {

Eigen::Vector3d vector_of(const double (&xyz)[3]) {
  return Eigen::Map<const Eigen::Vector3d>(xyz);
}

Eigen::Quaterniond attitude_of(const dottrack_pose& pose) {
  const auto& q = pose.orientation_wxyz;
  return {q[0], q[1], q[2], q[3]};
}

// Half a turn about the line between x and y.
Eigen::Quaterniond ned_enu() {
  constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  return {0.0, kHalf, kHalf, 0.0};
}

// Half a turn about x, the way round that makes a level vehicle heading north the identity.
Eigen::Quaterniond flu_frd() {
  return {0.0, -1.0, 0.0, 0.0};
}

}  // namespace

Eigen::Vector3d ned_from_enu(const Eigen::Vector3d& vector) {
  return {vector.y(), vector.x(), -vector.z()};
}

Eigen::Vector3d frd_from_flu(const Eigen::Vector3d& vector) {
  return {vector.x(), -vector.y(), -vector.z()};
}

Eigen::Quaterniond ned_frd_from_enu_flu(const Eigen::Quaterniond& enu_flu) {
  return (ned_enu() * enu_flu * flu_frd()).normalized();
}

Matrix6d ned_from_enu(const Matrix6d& covariance) {
  Eigen::Matrix3d turn;
  turn << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = turn;
  jacobian.bottomRightCorner<3, 3>() = turn;
  return jacobian * covariance * jacobian.transpose();
}

EulerAngles euler_angles(const Eigen::Quaterniond& attitude) {
  constexpr double kNoseUpright = 1e-6;  // cosine of pitch: roll and yaw are noise below it
  const Eigen::Matrix3d r = attitude.toRotationMatrix();
  const double level = std::hypot(r(0, 0), r(1, 0));
  const double pitch = std::atan2(-r(2, 0), level);
  if (level < kNoseUpright) {
    return {.roll = 0.0, .pitch = pitch, .yaw = std::atan2(-r(0, 1), r(1, 1))};
  }
  return {
      .roll = std::atan2(r(2, 1), r(2, 2)), .pitch = pitch, .yaw = std::atan2(r(1, 0), r(0, 0))};
}

NedPose ned_pose(const dottrack_pose& pose) {
  const Eigen::Quaterniond attitude = attitude_of(pose);
  NedPose ned;
  ned.position_m = ned_from_enu(vector_of(pose.position_m));
  ned.attitude = ned_frd_from_enu_flu(attitude);
  if (pose.has_covariance) {
    using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
    ned.covariance = ned_from_enu(Matrix6d(Eigen::Map<const RowMajor>(pose.covariance)));
  }
  if (pose.has_velocity) {
    ned.velocity_m_s = frd_from_flu(attitude.conjugate() * vector_of(pose.velocity_m_s));
  }
  if (pose.has_rates) ned.rates_rad_s = frd_from_flu(vector_of(pose.rates_rad_s));
  return ned;
}

}  // namespace dottrack::workstation
