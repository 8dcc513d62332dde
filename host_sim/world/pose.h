#pragma once
// A rigid placement of a body in the world.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dottrack::host_sim {

// T_world_body: p_world = rotation * p_body + position_m.
struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // columns: the body's axes in the world

  Eigen::Vector3d to_world(const Eigen::Vector3d& p_body) const {
    return rotation * p_body + position_m;
  }
  Eigen::Vector3d to_body(const Eigen::Vector3d& p_world) const {
    return rotation.transpose() * (p_world - position_m);
  }
  // Hamilton, body to world, w >= 0.
  Eigen::Quaterniond orientation() const {
    Eigen::Quaterniond q(rotation);
    q.normalize();
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    return q;
  }
};

}  // namespace dottrack::host_sim
