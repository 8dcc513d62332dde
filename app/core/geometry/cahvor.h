#pragma once
// CAHVOR: CAHV with radial lens distortion about an optical axis of its own (Yakimovsky,
// Gennery 1979; paper section 3.4, [14]).
//   d = P - C;  w = d.O;  l = d - w O;  tau = l.l / w^2;  mu = r0 + r1 tau + r2 tau^2
//   d' = d + mu l;  x = d'.H / d'.A;  y = d'.V / d'.A
// Nothing is normalised: |O| is taken as given.
// The lens's domain is where the distorted radius r (1 + mu(r^2)), r = sqrt(tau), has risen all
// the way from the axis (no fold), and where the distorted point is in front of the image plane.

#include <Eigen/Core>

#include "app/core/geometry/optics_status.h"
#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

struct Cahvor {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();   // centre of projection, metres, world
  Eigen::Vector3d a = Eigen::Vector3d::UnitZ();  // normal of the image plane, unit, world
  Eigen::Vector3d h = Eigen::Vector3d::UnitX();  // hs H' + hc A: scale and centre column, pixels
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  // vs V' + vc A: scale and centre row, pixels
  Eigen::Vector3d o = Eigen::Vector3d::UnitZ();  // optical axis, unit, world
  Eigen::Vector3d r = Eigen::Vector3d::Zero();   // radial distortion, no unit
};

// 3-D to 2-D: point in metres (world) to pixel, with d(x, y)/d(X, Y, Z) in pixels a metre when
// asked for. Closed form. Outputs are written only when ok.
OpticsStatus project(const Cahvor& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian = nullptr) noexcept;

// 2-D to 3-D: pixel to ray, with its derivatives when asked for; the direction's is tangent to
// the unit sphere. Iterates to double precision, bounded. Outputs are written only when ok.
OpticsStatus unproject(const Cahvor& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian = nullptr) noexcept;

}  // namespace dottrack::geometry
