#pragma once
// From dottrack's frames (world: z up; vehicle: forward-left-up) to an autopilot's
// (north-east-down, forward-right-down), after REP 103 and REP 147: north = y, east = x, down = -z,
// as if the world's x pointed east; right = -left, down = -up. Both are half turns, so vectors and
// rotations about axes change alike. SI units, radians; quaternions Hamilton, unit, body to world.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "app/core/protocol/receiver/dottrack_receiver.h"

namespace dottrack::workstation {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d ned_from_enu(const Eigen::Vector3d& vector);  // world axes
Eigen::Vector3d frd_from_flu(const Eigen::Vector3d& vector);  // vehicle axes

// Of the same attitude; its sign is continuous where the argument's is.
Eigen::Quaterniond ned_frd_from_enu_flu(const Eigen::Quaterniond& enu_flu);

// x y z and the rotations about the world's x y z axes, to north, east, down and the rotations
// about those: for small errors of a vehicle that is nearly level what MAVLink calls roll, pitch,
// yaw.
Matrix6d ned_from_enu(const Matrix6d& covariance);

// First yaw about z, then pitch about the new y, then roll about the new x. With the nose straight
// up or down, yaw and roll turn about the same axis: then roll is 0 and yaw has it all.
struct EulerAngles {
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
};
EulerAngles euler_angles(const Eigen::Quaterniond& attitude);

// A pose as an autopilot takes it. What is empty is not known.
struct NedPose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();          // north, east, down
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  // FRD to NED
  std::optional<Matrix6d> covariance;                            // NED
  std::optional<Eigen::Vector3d> velocity_m_s;                   // FRD
  std::optional<Eigen::Vector3d> rates_rad_s;                    // FRD
};
NedPose ned_pose(const dottrack_pose& pose);

}  // namespace dottrack::workstation
