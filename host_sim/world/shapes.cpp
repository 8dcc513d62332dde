#include "host_sim/world/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace dottrack::host_sim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNearest = 1e-9;  // a line does not meet the surface that it starts on

Eigen::Vector3d facing(const Eigen::Vector3d& normal, const Line& line) {
  return normal.dot(line.direction) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

// Distance along the line to the plane through `point`; kNever when parallel.
double to_plane(const Line& line, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const double slope = normal.dot(line.direction);
  return slope == 0.0 ? kNever : normal.dot(point - line.origin) / slope;
}

bool accept(double distance) {
  return distance > kNearest && distance < kNever;
}

bool meets(const Disc& disc, const Line& line, Hit& hit) {
  const double distance = to_plane(line, disc.centre, disc.normal);
  if (!accept(distance)) return false;
  const Eigen::Vector3d p = line.origin + distance * line.direction;
  if ((p - disc.centre).squaredNorm() > disc.radius_m * disc.radius_m) return false;
  hit = {distance, facing(disc.normal, line)};
  return true;
}

bool meets(const Outline& outline, const Line& line, Hit& hit) {
  const double distance = to_plane(line, outline.origin, outline.normal);
  if (!accept(distance)) return false;
  const Eigen::Vector3d p = line.origin + distance * line.direction - outline.origin;
  if (!inside_outline(outline.vertices, {p.dot(outline.axis_u), p.dot(outline.axis_v)})) {
    return false;
  }
  hit = {distance, facing(outline.normal, line)};
  return true;
}

bool meets(const Convex& convex, const Line& line, Hit& hit) {
  double enter = -kNever;
  double leave = kNever;
  const Face* entered = nullptr;
  const Face* left = nullptr;
  for (const Face& face : convex.faces) {
    const double slope = face.normal.dot(line.direction);
    const double gap = face.offset_m - face.normal.dot(line.origin);
    if (slope == 0.0) {
      if (gap < 0.0) return false;
    } else if (slope < 0.0 && gap / slope > enter) {
      enter = gap / slope;
      entered = &face;
    } else if (slope > 0.0 && gap / slope < leave) {
      leave = gap / slope;
      left = &face;
    }
  }
  if (enter > leave) return false;
  const bool from_outside = enter > kNearest;
  const Face* face = from_outside ? entered : left;
  const double distance = from_outside ? enter : leave;
  if (face == nullptr || !accept(distance)) return false;
  hit = {distance, facing(face->normal, line)};
  return true;
}

bool meets_wall(const Cylinder& cylinder, const Line& line, Hit& hit) {
  const Eigen::Vector3d o = line.origin - cylinder.base;
  const double along = line.direction.dot(cylinder.axis);
  const double offset = o.dot(cylinder.axis);
  const Eigen::Vector3d d_across = line.direction - along * cylinder.axis;
  const Eigen::Vector3d o_across = o - offset * cylinder.axis;
  const double a = d_across.squaredNorm();
  const double b = d_across.dot(o_across);
  const double c = o_across.squaredNorm() - cylinder.radius_m * cylinder.radius_m;
  const double discriminant = b * b - a * c;
  if (a == 0.0 || discriminant < 0.0) return false;
  const double root = std::sqrt(discriminant);
  for (const double distance : {(-b - root) / a, (-b + root) / a}) {
    const double height = offset + distance * along;
    if (!accept(distance) || height < 0.0 || height > cylinder.length_m) continue;
    hit = {distance, facing((o_across + distance * d_across) / cylinder.radius_m, line)};
    return true;
  }
  return false;
}

bool meets(const Cylinder& cylinder, const Line& line, Hit& hit) {
  bool found = meets_wall(cylinder, line, hit);
  for (const double height : {0.0, cylinder.length_m}) {
    const Disc cap{cylinder.base + height * cylinder.axis, cylinder.axis, cylinder.radius_m};
    Hit at_cap;
    if (meets(cap, line, at_cap) && (!found || at_cap.distance < hit.distance)) {
      hit = at_cap;
      found = true;
    }
  }
  return found;
}

bool meets(const Ball& ball, const Line& line, Hit& hit) {
  const Eigen::Vector3d o = line.origin - ball.centre;
  const double a = line.direction.squaredNorm();
  const double b = o.dot(line.direction);
  const double discriminant = b * b - a * (o.squaredNorm() - ball.radius_m * ball.radius_m);
  if (discriminant < 0.0) return false;
  const double root = std::sqrt(discriminant);
  const double distance = (-b - root) / a > kNearest ? (-b - root) / a : (-b + root) / a;
  if (!accept(distance)) return false;
  hit = {distance, facing((o + distance * line.direction) / ball.radius_m, line)};
  return true;
}

Ball bound(const Disc& disc) {
  return {disc.centre, disc.radius_m};
}
Ball bound(const Convex& convex) {
  return convex.bound;
}
Ball bound(const Ball& ball) {
  return ball;
}

Ball bound(const Cylinder& c) {
  return {c.base + 0.5 * c.length_m * c.axis,
          std::sqrt(0.25 * c.length_m * c.length_m + c.radius_m * c.radius_m)};
}

Ball bound(const Outline& outline) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& v : outline.vertices) middle += v;
  middle /= static_cast<double>(outline.vertices.size());
  double radius = 0.0;
  for (const Eigen::Vector2d& v : outline.vertices) radius = std::max(radius, (v - middle).norm());
  return {outline.origin + middle.x() * outline.axis_u + middle.y() * outline.axis_v, radius};
}

}  // namespace

bool inside_outline(const std::vector<Eigen::Vector2d>& vertices, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++) {
    const Eigen::Vector2d& a = vertices[i];
    const Eigen::Vector2d& b = vertices[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

bool intersect(const Shape& shape, const Line& line, Hit& hit) {
  return std::visit([&](const auto& s) { return meets(s, line, hit); }, shape);
}

Ball bounding_ball(const Shape& shape) {
  return std::visit([](const auto& s) { return bound(s); }, shape);
}

Outline make_outline(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis_u,
                     const Eigen::Vector3d& axis_v, std::vector<Eigen::Vector2d> vertices) {
  return {origin, axis_u, axis_v, axis_u.cross(axis_v), std::move(vertices)};
}

Convex make_box(const Pose& pose, const Eigen::Vector3d& size_m) {
  Convex box;
  box.bound = {pose.position_m, 0.5 * size_m.norm()};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d normal = side * pose.rotation.col(axis);
      box.faces.push_back({normal, normal.dot(pose.position_m) + 0.5 * size_m[axis]});
    }
  }
  return box;
}

}  // namespace dottrack::host_sim
