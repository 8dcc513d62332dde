#pragma once
// CAHVORE: CAHVOR for perspective, fish-eye and other lenses, with an entrance pupil that moves
// along the axis (Gennery 2006; paper section 3.4, [15]).
//   d = P - C;  zeta = d.O;  lambda = d - zeta O;  E(t) = e0 + e1 t^2 + e2 t^4
//   theta: zeta sin theta - |lambda| cos theta - (theta - sin theta) E(theta) = 0
//   chi = tan(L theta)/L (L > 0), theta (L = 0), sin(L theta)/L (L < 0)
//   rho = chi (1 + r0 + r1 chi^2 + r2 chi^4);  d' = O + rho lambda/|lambda|
//   x = d'.H / d'.A;  y = d'.V / d'.A
// Nothing is normalised: |O| is taken as given, so a ray's direction is as long as O allows (unit
// to some 1e-7 for published models of six digits).
// The lens's domain ends where |L| theta reaches 90 degrees, where rho stops rising, at
// kWidestHalfAngle_rad, or where d' leaves the front of the image plane, whichever is first.
// A fish-eye may see points behind the plane through C.

#include <Eigen/Core>

#include "app/core/geometry/optics_status.h"
#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

// No lens made sees further than this off its axis (280 degrees in all): what a polynomial without
// a fold says beyond it is no image.
inline constexpr double kWidestHalfAngle_rad = 2.443460952792061;

struct Cahvore {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();   // centre of projection, metres, world
  Eigen::Vector3d a = Eigen::Vector3d::UnitZ();  // normal of the image plane, unit, world
  Eigen::Vector3d h = Eigen::Vector3d::UnitX();  // hs H' + hc A: scale and centre column, pixels
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  // vs V' + vc A: scale and centre row, pixels
  Eigen::Vector3d o = Eigen::Vector3d::UnitZ();  // optical axis, unit, world
  Eigen::Vector3d r = Eigen::Vector3d::Zero();   // radial distortion, in chi
  Eigen::Vector3d e = Eigen::Vector3d::Zero();   // entrance pupil, metres, in theta
  double linearity = 1.0;                        // L: 1 perspective, 0 fish-eye, else general
};

// 3-D to 2-D: point in metres (world) to pixel, with d(x, y)/d(X, Y, Z) in pixels a metre when
// asked for: those of this very function, whatever |O|. Iterates, bounded. Outputs are written
// only when ok.
OpticsStatus project(const Cahvore& model, const Eigen::Vector3d& p_world, Eigen::Vector2d& pixel,
                     ProjectionJacobian* jacobian = nullptr) noexcept;

// 2-D to 3-D: pixel to ray, with its derivatives when asked for; the origin moves with the pupil.
// Iterates, bounded. Outputs are written only when ok.
OpticsStatus unproject(const Cahvore& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian = nullptr) noexcept;

}  // namespace dottrack::geometry
