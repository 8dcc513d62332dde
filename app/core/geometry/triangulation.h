#pragma once
// The point closest to n lines of sight in the least-squares sense (paper appendix).

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

struct SightLine {
  Ray ray;
  double sigma_rad = 0.0;  // standard deviation of the direction about each perpendicular axis
};

struct Triangulation {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();        // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // that the lines' sigmas imply
  double rms_miss_m = 0.0;                                  // of the lines' distances to the point
};

enum class TriangulationStatus : std::uint8_t {
  ok,
  too_few_lines,  // fewer than two
  degenerate,     // all lines nearly parallel
};

// Solved with equal weights first, then with the inverse square of each line's range, which is
// the best weighting for directions of equal accuracy. Minimises sum w |(I - u u^T)(p - b)|^2.
// The output is written only when the status is ok.
TriangulationStatus triangulate(std::span<const SightLine> lines, Triangulation& result);

}  // namespace dottrack::geometry
