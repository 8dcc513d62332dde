#pragma once
// What a thing is made of: solids of one material each, and round marks painted on them. All in the
// thing's own coordinates, metres; the hall's are the world's.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "host_sim/world/material.h"

namespace dottrack::host_sim {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
  bool smooth = false;  // shaded as the curved surface that the facets stand for
};

struct Balls {
  std::vector<Eigen::Vector4f> balls;  // x y z radius
};

// Round in section, straight from point to point.
struct Cable {
  std::vector<Eigen::Vector4f> path;  // x y z radius; two points or more
};

using Solid = std::variant<TriangleMesh, Balls, Cable>;

struct Part {
  Solid solid;
  Material material;
};

// A disc painted on a flat face: a dot of the target, a calibration dot or something that looks
// like one. Its edge is rendered exactly, which no mesh would be.
struct Mark {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d normal;  // unit, of the face, outwards
  double radius_m = 0.0;
  double albedo = 0.9;
  std::size_t part = 0;  // that it is painted on
};

struct Model {
  std::vector<Part> parts;
  std::vector<Mark> marks;
};

}  // namespace dottrack::host_sim
