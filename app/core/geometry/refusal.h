#pragma once
// Why a point or a pixel is refused. Off the fast path: called once something is already wrong.

#include <Eigen/Core>
#include <cmath>

#include "app/core/geometry/optics_status.h"

namespace dottrack::geometry {

// Closer to the centre than this a point has no direction worth the name.
inline constexpr double kCentreRadiusSquared_m2 = 1e-24;
// Sine squared of the angle to the plane through C below which a point is in that plane.
inline constexpr double kGrazingSineSquared = 1e-18;

// Whether a depth is clearly positive for a vector of this squared length.
inline bool clearly_in_front(double depth, double squared_length) noexcept {
  return depth > 0.0 && depth * depth > kGrazingSineSquared * squared_length &&
         squared_length > kCentreRadiusSquared_m2;
}

// The reason for a point at d from the centre that is not in front of the camera.
inline OpticsStatus refuse_point(const Eigen::Vector3d& d, OpticsStatus otherwise) noexcept {
  const double squared_length = d.squaredNorm();
  if (!std::isfinite(squared_length)) return OpticsStatus::not_finite;
  return squared_length > kCentreRadiusSquared_m2 ? otherwise : OpticsStatus::at_centre;
}

inline OpticsStatus refuse_pixel(const Eigen::Vector2d& pixel) noexcept {
  return std::isfinite(pixel.squaredNorm()) ? OpticsStatus::outside_domain
                                            : OpticsStatus::not_finite;
}

}  // namespace dottrack::geometry
