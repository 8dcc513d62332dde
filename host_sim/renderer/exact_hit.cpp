#include "host_sim/renderer/exact_hit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

// The root of |line(t) - centre| = radius next to `near`.
double on_ball(const Line& line, const Vector3d& centre, double radius_m, double near) {
  const Vector3d to_line = line.origin - centre;
  const double a = line.direction.squaredNorm();
  const double b = line.direction.dot(to_line);
  const double discriminant = b * b - a * (to_line.squaredNorm() - radius_m * radius_m);
  if (discriminant <= 0.0) return near;
  const double half = std::sqrt(discriminant);
  const double first = (-b - half) / a;
  const double second = (-b + half) / a;
  return std::abs(first - near) <= std::abs(second - near) ? first : second;
}

}  // namespace

ExactHit exact_hit(const TriangleMesh& mesh, std::size_t triangle,
                   const std::vector<Eigen::Vector3f>& vertex_normals, const Line& line,
                   double near) {
  const auto& corners = mesh.triangles[triangle];
  const Vector3d a = mesh.vertices[corners[0]].cast<double>();
  const Vector3d ab = mesh.vertices[corners[1]].cast<double>() - a;
  const Vector3d ac = mesh.vertices[corners[2]].cast<double>() - a;
  const Vector3d flat = ab.cross(ac);
  const double slope = flat.dot(line.direction);
  const double area2 = flat.squaredNorm();
  const bool grazing = slope * slope < 1e-16 * area2 * line.direction.squaredNorm();
  const double distance = grazing ? near : flat.dot(a - line.origin) / slope;
  if (vertex_normals.empty()) return {distance, flat};
  const Vector3d p = line.at(distance) - a;
  const double v = std::clamp(flat.dot(p.cross(ac)) / area2, 0.0, 1.0);
  const double w = std::clamp(flat.dot(ab.cross(p)) / area2, 0.0, 1.0 - v);
  return {distance, (1.0 - v - w) * vertex_normals[corners[0]].cast<double>() +
                        v * vertex_normals[corners[1]].cast<double>() +
                        w * vertex_normals[corners[2]].cast<double>()};
}

ExactHit exact_hit(const Balls& balls, std::size_t ball, const Line& line, double near) {
  const Eigen::Vector4d b = balls.balls[ball].cast<double>();
  const double distance = on_ball(line, b.head<3>(), b.w(), near);
  return {distance, line.at(distance) - b.head<3>()};
}

// By Newton's method on the distance to a segment whose radius changes evenly along it.
ExactHit exact_hit(const Cable& cable, std::size_t segment, const Line& line, double near) {
  const Eigen::Vector4d a = cable.path[segment].cast<double>();
  const Eigen::Vector4d b = cable.path[segment + 1].cast<double>();
  const Vector3d axis = b.head<3>() - a.head<3>();
  const double length2 = axis.squaredNorm();
  double distance = near;
  Vector3d outwards = Vector3d::Zero();
  for (int round = 0; round < 4; ++round) {
    const Vector3d p = line.at(distance) - a.head<3>();
    const double along = length2 > 0.0 ? std::clamp(p.dot(axis) / length2, 0.0, 1.0) : 0.0;
    outwards = p - along * axis;
    const double norm = outwards.norm();
    const double slope = outwards.dot(line.direction);
    if (!(slope * slope > 1e-4 * norm * norm * line.direction.squaredNorm())) break;  // grazing
    distance -= (norm - (a.w() + along * (b.w() - a.w()))) * norm / slope;
  }
  return {distance, outwards};
}

std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  for (const auto& corners : mesh.triangles) {
    const Vector3d a = mesh.vertices[corners[0]].cast<double>();
    const Vector3d ab = mesh.vertices[corners[1]].cast<double>() - a;
    const Vector3d ac = mesh.vertices[corners[2]].cast<double>() - a;
    for (const std::uint32_t corner : corners) sums[corner] += ab.cross(ac);
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sums.size());
  for (const Vector3d& sum : sums) normals.push_back(sum.normalized().cast<float>());
  return normals;
}

}  // namespace dottrack::host_sim
