#include "host_sim/world/outline.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "host_sim/world/meshes.h"
#include "host_sim/world/model.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool in_triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

// Whether the corner `at` of what is left of the outline can be cut off.
bool is_ear(const Outline& outline, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::uint32_t before = left[(at + left.size() - 1) % left.size()];
  const std::uint32_t after = left[(at + 1) % left.size()];
  const Vector2d& a = outline[before];
  const Vector2d& b = outline[left[at]];
  const Vector2d& c = outline[after];
  if (cross(b - a, c - b) <= 0.0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t i) {
    return i != before && i != left[at] && i != after && in_triangle(a, b, c, outline[i]);
  });
}

}  // namespace

bool inside(const Outline& outline, const Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) in = !in;
  }
  return in;
}

double distance_to_edge(const Outline& outline, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - t * edge).norm());
  }
  return least;
}

std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> left(outline.size());
  std::iota(left.begin(), left.end(), 0U);
  while (left.size() > 3) {
    std::size_t at = 0;
    while (at + 1 < left.size() && !is_ear(outline, left, at)) ++at;
    triangles.push_back(
        {left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

TriangleMesh prism(const Outline& outline, double bottom_m, double top_m) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {bottom_m, top_m}) {
    for (const Vector2d& p : outline) {
      mesh.vertices.push_back(Eigen::Vector3d(p.x(), p.y(), z).cast<float>());
    }
  }
  for (const auto& [a, b, c] : triangulated(outline)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + n, b + n, c + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, j + n});
    mesh.triangles.push_back({i, j + n, i + n});
  }
  return mesh;
}

}  // namespace dottrack::host_sim
