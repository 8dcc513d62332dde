#pragma once
// What a camera model answers beside numbers: a point it cannot see is a result, never a pixel.

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace dottrack::geometry {

enum class OpticsStatus : std::uint8_t {
  ok,
  behind,          // the point is behind the camera or in the plane of its centre
  at_centre,       // the point is the camera's centre: no direction
  outside_domain,  // beyond what the lens's distortion describes
  not_converged,   // the iteration did not settle within its bound
  not_finite,      // an input is NaN or infinite
};

// One word: ok, behind, at_centre, outside_domain, not_converged, not_finite.
std::string_view to_string(OpticsStatus status);

using ProjectionJacobian = Eigen::Matrix<double, 2, 3>;

}  // namespace dottrack::geometry
