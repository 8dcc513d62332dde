#pragma once
// Outlines in the plane: simple polygons, counter-clockwise.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace dottrack::host_sim {

using Outline = std::vector<Eigen::Vector2d>;

bool inside(const Outline& outline, const Eigen::Vector2d& p);

// From the nearest edge, on either side of it.
double distance_to_edge(const Outline& outline, const Eigen::Vector2d& p);

// Triangles of its vertices that fill it, counter-clockwise.
std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline);

}  // namespace dottrack::host_sim
