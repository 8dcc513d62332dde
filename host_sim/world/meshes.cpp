#include "host_sim/world/meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::uint32_t add_vertex(TriangleMesh& mesh, const Vector3d& p) {
  mesh.vertices.push_back(p.cast<float>());
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// Indices of the ring's vertices, counter-clockwise about the frame's z; one where it is a point.
std::vector<std::uint32_t> add_ring(TriangleMesh& mesh, const Pose& frame, double radius_m,
                                    double z_m, int sides) {
  if (radius_m == 0.0) return {add_vertex(mesh, frame.to_world({0.0, 0.0, z_m}))};
  std::vector<std::uint32_t> ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * kPi * i / sides;
    const Vector3d p(radius_m * cosine(angle), radius_m * sine(angle), z_m);
    ring.push_back(add_vertex(mesh, frame.to_world(p)));
  }
  return ring;
}

void add_band(TriangleMesh& mesh, const std::vector<std::uint32_t>& low,
              const std::vector<std::uint32_t>& high) {
  const std::size_t sides = std::max(low.size(), high.size());
  const auto at = [](const auto& ring, std::size_t i) { return ring[i % ring.size()]; };
  for (std::size_t i = 0; i < sides; ++i) {
    if (low.size() > 1) {
      mesh.triangles.push_back({at(low, i), at(low, i + 1), at(high, i + 1)});
    }
    if (high.size() > 1) {
      mesh.triangles.push_back({at(low, i), at(high, i + 1), at(high, i)});
    }
  }
}

void add_fan(TriangleMesh& mesh, const std::vector<std::uint32_t>& ring, bool faces_up) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const auto a = ring[faces_up ? i : i + 1];
    const auto b = ring[faces_up ? i + 1 : i];
    mesh.triangles.push_back({ring[0], a, b});
  }
}

}  // namespace

Pose upright(const Vector3d& position_m, double yaw_rad) {
  const double c = cosine(yaw_rad);
  const double s = sine(yaw_rad);
  Pose pose;
  pose.position_m = position_m;
  pose.rotation << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return pose;
}

Pose facing(const Vector3d& position_m, const Vector3d& z_axis) {
  const Vector3d aside = std::abs(z_axis.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  Pose pose;
  pose.position_m = position_m;
  pose.rotation.col(2) = z_axis;
  pose.rotation.col(1) = z_axis.cross(aside).normalized();
  pose.rotation.col(0) = pose.rotation.col(1).cross(z_axis);
  return pose;
}

TriangleMesh box(const Pose& middle, const Vector3d& size_m) {
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1U) != 0 ? 0.5 : -0.5, (corner & 2U) != 0 ? 0.5 : -0.5,
                        (corner & 4U) != 0 ? 0.5 : -0.5);
    add_vertex(mesh, middle.to_world(sign.cwiseProduct(size_m)));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh revolved(const Vector3d& base_m, const Vector3d& axis,
                      const std::vector<Vector2d>& profile_m, int sides) {
  TriangleMesh mesh;
  mesh.smooth = true;
  const Pose frame = facing(base_m, axis);
  std::vector<std::uint32_t> low;
  for (const Vector2d& point : profile_m) {
    auto ring = add_ring(mesh, frame, point.x(), point.y(), sides);
    if (!low.empty()) add_band(mesh, low, ring);
    low = std::move(ring);
  }
  return mesh;
}

TriangleMesh stump(const Vector3d& base_m, const Vector3d& axis, double length_m,
                   double base_radius_m, double top_radius_m, int sides) {
  TriangleMesh mesh =
      revolved(base_m, axis, {{base_radius_m, 0.0}, {top_radius_m, length_m}}, sides);
  // The ends have vertices of their own: shared ones would shade the edges round.
  const Pose frame = facing(base_m, axis);
  add_fan(mesh, add_ring(mesh, frame, base_radius_m, 0.0, sides), false);
  add_fan(mesh, add_ring(mesh, frame, top_radius_m, length_m, sides), true);
  return mesh;
}

TriangleMesh cylinder(const Vector3d& base_m, const Vector3d& axis, double length_m,
                      double radius_m, int sides) {
  return stump(base_m, axis, length_m, radius_m, radius_m, sides);
}

TriangleMesh disc_plate(const Vector3d& face_m, const Vector3d& normal, double radius_m,
                        double thickness_m, int sides) {
  return cylinder(face_m - thickness_m * normal, normal, thickness_m, radius_m, sides);
}

TriangleMesh ellipsoid(const Pose& middle, const Vector3d& semi_axes_m, int rings) {
  std::vector<Vector2d> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = kPi * i / rings;
    const bool pole = i == 0 || i == rings;
    profile.emplace_back(pole ? 0.0 : sine(angle), -cosine(angle));
  }
  TriangleMesh mesh = revolved(Vector3d::Zero(), Vector3d::UnitZ(), profile, 2 * rings);
  for (Eigen::Vector3f& v : mesh.vertices) {
    v = middle.to_world(v.cast<double>().cwiseProduct(semi_axes_m)).cast<float>();
  }
  return mesh;
}

TriangleMesh limb(const Vector3d& from_m, const Vector3d& to_m, double from_radius_m,
                  double to_radius_m, int sides) {
  const int steps = 4;  // in a quarter of a circle
  const double length_m = (to_m - from_m).norm();
  std::vector<Vector2d> profile;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 0.5 * kPi * i / steps;
    profile.emplace_back(i == 0 ? 0.0 : from_radius_m * sine(angle),
                         -from_radius_m * cosine(angle));
  }
  for (int i = 0; i <= steps; ++i) {
    const double angle = 0.5 * kPi * i / steps;
    profile.emplace_back(i == steps ? 0.0 : to_radius_m * cosine(angle),
                         length_m + to_radius_m * sine(angle));
  }
  return revolved(from_m, (to_m - from_m) / length_m, profile, sides);
}

TriangleMesh heightfield(const std::function<double(const Vector2d&)>& height_m, const Range& x,
                         const Range& y, double step_m) {
  TriangleMesh mesh;
  mesh.smooth = true;
  const auto columns = static_cast<std::uint32_t>(std::ceil((x.high - x.low) / step_m - 1e-9));
  const auto rows = static_cast<std::uint32_t>(std::ceil((y.high - y.low) / step_m - 1e-9));
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const Vector2d p(x.low + (x.high - x.low) * i / columns, y.low + (y.high - y.low) * j / rows);
      add_vertex(mesh, {p.x(), p.y(), height_m(p)});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i;
      const std::uint32_t b = a + columns + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const Pose& pose) {
  for (Eigen::Vector3f& v : mesh.vertices) v = pose.to_world(v.cast<double>()).cast<float>();
  return mesh;
}

}  // namespace dottrack::host_sim
