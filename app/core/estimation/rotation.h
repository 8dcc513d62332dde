#pragma once
// Small tools of rotations: vectors whose direction is the axis and whose length is the angle.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dottrack::estimation {

// The turn about `vector_rad` by its length.
Eigen::Quaterniond turn_by(const Eigen::Vector3d& vector_rad);

// The axis times the angle, which is the shorter of the two that a quaternion stands for.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation);

// J with turn_by(v + d) = turn_by(J d) turn_by(v) for small d (the left Jacobian of SO(3)).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& vector_rad);

}  // namespace dottrack::estimation
