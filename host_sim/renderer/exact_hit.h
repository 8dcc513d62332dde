#pragma once
// Where a line meets a solid that it is known to meet, in double precision.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "host_sim/world/model.h"

namespace dottrack::host_sim {

struct Line {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

struct ExactHit {
  double distance;
  Eigen::Vector3d normal;  // outwards, not unit
};

// `near` is the distance as far as it is known; it stands where the line only grazes the solid.
// vertex_normals: one a vertex for a smooth mesh, else empty.
ExactHit exact_hit(const TriangleMesh& mesh, std::size_t triangle,
                   const std::vector<Eigen::Vector3f>& vertex_normals, const Line& line,
                   double near);
ExactHit exact_hit(const Balls& balls, std::size_t ball, const Line& line, double near);
ExactHit exact_hit(const Cable& cable, std::size_t segment, const Line& line, double near);

// Mean normals of the triangles around each vertex, by area.
std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh);

}  // namespace dottrack::host_sim
