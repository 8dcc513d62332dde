#pragma once
// Absolute orientation: the rigid motion that carries one labelled point set onto another, by the
// quaternion method of Faugeras and Hebert (paper reference [11]).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>

namespace dottrack::geometry {

struct RigidMotion {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit, body to world

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return rotation * p + translation_m; }
};

enum class OrientationStatus : std::uint8_t {
  ok,
  too_few_points,  // fewer than three
  degenerate,      // the points of either set lie on a line, or the rotation is not determined
};

// Minimises sum |world - (R body + t)|^2 over proper rotations. Both sets in the same order,
// metres. The output is written only when the status is ok.
OrientationStatus absolute_orientation(std::span<const Eigen::Vector3d> body,
                                       std::span<const Eigen::Vector3d> world, RigidMotion& motion);

// Root mean square of |world - motion * body| over the points, metres.
double rms_residual(std::span<const Eigen::Vector3d> body, std::span<const Eigen::Vector3d> world,
                    const RigidMotion& motion);

// True when the points do not lie on one line: the spread across the best line is more than a
// thousandth of the spread along it.
bool spans_a_plane(std::span<const Eigen::Vector3d> points);

}  // namespace dottrack::geometry
