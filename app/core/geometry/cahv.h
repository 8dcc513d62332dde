#pragma once
// CAHV: the linear (pinhole) camera model of JPL (Yakimovsky and Cunningham 1978; paper section
// 3.4, [12]).
//   d = P - C;  x = d.H / d.A;  y = d.V / d.A

#include <Eigen/Core>

#include "app/core/geometry/optics_status.h"
#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

struct Cahv {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();   // centre of projection, metres, world
  Eigen::Vector3d a = Eigen::Vector3d::UnitZ();  // normal of the image plane, unit, world
  Eigen::Vector3d h = Eigen::Vector3d::UnitX();  // hs H' + hc A: scale and centre column, pixels
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  // vs V' + vc A: scale and centre row, pixels
};

// 3-D to 2-D: point in metres (world) to pixel, with d(x, y)/d(X, Y, Z) in pixels a metre when
// asked for. behind: on or behind the plane through C. Outputs are written only when ok.
OpticsStatus project(const Cahv& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian = nullptr) noexcept;

// 2-D to 3-D: pixel to ray, with its derivatives when asked for. outside_domain: H and V do not
// span an image. Outputs are written only when ok.
OpticsStatus unproject(const Cahv& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian = nullptr) noexcept;

}  // namespace dottrack::geometry
