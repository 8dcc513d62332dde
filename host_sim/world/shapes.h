#pragma once
// The solids and surfaces a world is built of, and where a line of sight meets them.
// All are in the coordinates of the body they belong to; metres.

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

struct Line {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // any length; distances along the line are in units of it
};

struct Hit {
  double distance = 0.0;   // along the line, > 0
  Eigen::Vector3d normal;  // unit, towards the side the line comes from
};

struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

struct Disc {
  Eigen::Vector3d centre;
  Eigen::Vector3d normal;  // unit
  double radius_m;
};

// A flat outline; it need not be convex.
struct Outline {
  Eigen::Vector3d origin;
  Eigen::Vector3d axis_u;                 // unit, in the plane
  Eigen::Vector3d axis_v;                 // unit, in the plane, at right angles to axis_u
  Eigen::Vector3d normal;                 // unit, axis_u x axis_v
  std::vector<Eigen::Vector2d> vertices;  // in (u, v); the last joins the first
};

// The points p with normal . p <= offset for every face.
struct Face {
  Eigen::Vector3d normal;  // unit, outwards
  double offset_m;
};
struct Convex {
  std::vector<Face> faces;
  Ball bound;  // contains it
};

struct Cylinder {
  Eigen::Vector3d base;  // centre of one end
  Eigen::Vector3d axis;  // unit
  double length_m;
  double radius_m;
};

using Shape = std::variant<Disc, Outline, Convex, Cylinder, Ball>;

// Nearest meeting of the line and the shape, in front of the line's origin.
bool intersect(const Shape& shape, const Line& line, Hit& hit);

// A ball that contains the shape.
Ball bounding_ball(const Shape& shape);

Outline make_outline(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis_u,
                     const Eigen::Vector3d& axis_v, std::vector<Eigen::Vector2d> vertices);

// A box of the given size, its middle at `pose`.
Convex make_box(const Pose& pose, const Eigen::Vector3d& size_m);

// Even-odd rule; `vertices` closes itself.
bool inside_outline(const std::vector<Eigen::Vector2d>& vertices, const Eigen::Vector2d& p);

}  // namespace dottrack::host_sim
