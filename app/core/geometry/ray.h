#pragma once
// Lines of sight.

#include <Eigen/Core>

namespace dottrack::geometry {

// A half line in world coordinates, metres: origin + s * direction, s >= 0.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit length
};

// Derivatives of a ray by the pixel (x, y) it was seen at: metres a pixel, and 1 a pixel.
// The direction's derivative is tangent to the unit sphere.
struct RayJacobian {
  Eigen::Matrix<double, 3, 2> origin;
  Eigen::Matrix<double, 3, 2> direction;
};

}  // namespace dottrack::geometry
