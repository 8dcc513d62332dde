#pragma once
// Builders of solids, metres. Every mesh is closed and its triangles run counter-clockwise seen
// from outside (a heightfield is open: its outside is above).

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "host_sim/world/model.h"
#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

// A pose that is turned about z only.
Pose upright(const Eigen::Vector3d& position_m, double yaw_rad = 0.0);
// Some pose whose z axis is `z_axis` (unit).
Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& z_axis);

TriangleMesh box(const Pose& middle, const Eigen::Vector3d& size_m);
inline TriangleMesh box(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& size_m) {
  return box(Pose{middle_m, Eigen::Matrix3d::Identity()}, size_m);
}

// From `base_m` along `axis` (unit), with flat ends; the second a cone's stump.
TriangleMesh cylinder(const Eigen::Vector3d& base_m, const Eigen::Vector3d& axis, double length_m,
                      double radius_m, int sides = 16);
TriangleMesh stump(const Eigen::Vector3d& base_m, const Eigen::Vector3d& axis, double length_m,
                   double base_radius_m, double top_radius_m, int sides = 16);

// Turned about `axis` (unit) through `base_m`: (radius, way along the axis) from the bottom
// upwards. Closed where the outermost radii are 0.
TriangleMesh revolved(const Eigen::Vector3d& base_m, const Eigen::Vector3d& axis,
                      const std::vector<Eigen::Vector2d>& profile_m, int sides = 16);

// A round plate whose face's middle is `face_m`.
TriangleMesh disc_plate(const Eigen::Vector3d& face_m, const Eigen::Vector3d& normal,
                        double radius_m, double thickness_m, int sides = 24);

// An upright prism over an outline: simple, counter-clockwise seen from above, not always convex.
TriangleMesh prism(const std::vector<Eigen::Vector2d>& outline, double bottom_m, double top_m);

TriangleMesh ellipsoid(const Pose& middle, const Eigen::Vector3d& semi_axes_m, int rings = 12);

// A round limb with round ends; the radii may differ.
TriangleMesh limb(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double from_radius_m,
                  double to_radius_m, int sides = 12);

struct Range {
  double low;
  double high;
};
// z = height(x, y) on a lattice of at most `step_m`.
TriangleMesh heightfield(const std::function<double(const Eigen::Vector2d&)>& height_m,
                         const Range& x, const Range& y, double step_m);

// An irregular stone about the origin, nowhere further from it than `radius_m`.
TriangleMesh rock(std::uint64_t seed, double radius_m);

TriangleMesh transformed(TriangleMesh mesh, const Pose& pose);

// Both return the index of the (first) part that was added.
std::size_t add(Model& model, Solid solid, const Material& material);
std::size_t append(Model& model, const Model& other, const Pose& pose);

std::size_t triangle_count(const Model& model);

}  // namespace dottrack::host_sim
