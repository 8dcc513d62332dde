#include "host_sim/renderer/shadow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hal/base/static_vector.h"
#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {
namespace {

constexpr double kCell_m = 0.5;
constexpr int kColumnsAcross = 32;      // 16 m
constexpr double kTallest_m = 1.6;      // a column's height
constexpr double kOffSurface_m = 2e-3;  // so that a surface does not shade itself
constexpr double kGoldenAngle_rad = 2.39996322972865332;

double middle_of(int cell) {
  return (cell + 0.5 - 0.5 * kColumnsAcross) * kCell_m;
}

int cell_of(double x) {
  const int cell = static_cast<int>(std::floor(x / kCell_m)) + kColumnsAcross / 2;
  return std::clamp(cell, 0, kColumnsAcross - 1);
}

double to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

// Whether the ball comes near any of the lines from a point to the lamp's points. Those lines lie
// in a cone that widens to the lamp's radius.
bool in_cone_to_lamp(const Ball& ball, const Eigen::Vector3d& from, const LampDisc& lamp) {
  const Eigen::Vector3d axis = lamp.middle - from;
  const double length2 = axis.squaredNorm();
  const Eigen::Vector3d to_ball = ball.centre - from;
  const double along = to_ball.dot(axis) / length2;
  if (along * std::sqrt(length2) < -ball.radius_m) return false;
  const double far_end = along + ball.radius_m / std::sqrt(length2);
  const double reach_m = 1.001 * (ball.radius_m + 1.01 * lamp.radius_m * std::max(far_end, 0.0));
  return to_ball.squaredNorm() - along * along * length2 <= reach_m * reach_m;
}

}  // namespace

LampDisc key_lamp_disc(const Lighting& lighting) {
  const Eigen::Vector3d axis = lighting.key.position_m.normalized();
  const Eigen::Vector3d u = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d v = axis.cross(u);
  LampDisc lamp{lighting.key.position_m, lighting.key_radius_m, {}};
  const auto count = static_cast<double>(lamp.points.size());
  for (std::size_t i = 0; i < lamp.points.size(); ++i) {  // like a sunflower's seeds
    const double n = static_cast<double>(i);
    const double radius_m = lamp.radius_m * std::sqrt((n + 0.5) / count);
    const double angle = n * kGoldenAngle_rad;
    lamp.points[i] = lamp.middle + radius_m * (cosine(angle) * u + sine(angle) * v);
  }
  return lamp;
}

LampDisc to_body(const LampDisc& lamp, const Pose& body) {
  LampDisc moved{body.to_body(lamp.middle), lamp.radius_m, {}};
  std::transform(lamp.points.begin(), lamp.points.end(), moved.points.begin(),
                 [&](const Eigen::Vector3d& p) { return body.to_body(p); });
  return moved;
}

double visible_share(const LampDisc& lamp, const Eigen::Vector3d& from,
                     std::span<const Object> objects, std::span<const std::uint16_t> which) {
  StaticVector<const Object*, 64> near;
  for (const std::uint16_t i : which) {
    if (in_cone_to_lamp(objects[i].bound, from, lamp)) (void)try_push_back(near, &objects[i]);
  }
  if (near.empty()) return 1.0;
  int seen = 0;
  for (const Eigen::Vector3d& point : lamp.points) {
    const Line line{from, point - from};
    const bool blocked = std::any_of(near.begin(), near.end(), [&](const Object* object) {
      Hit hit;
      return intersect(object->shape, line, hit) && hit.distance < 1.0;
    });
    seen += blocked ? 0 : 1;
  }
  return static_cast<double>(seen) / static_cast<double>(lamp.points.size());
}

StillShadows::StillShadows(std::span<const Object> objects, const Lighting& lighting)
    : objects_(objects),
      lamp_(key_lamp_disc(lighting)),
      columns_(static_cast<std::size_t>(kColumnsAcross * kColumnsAcross)) {
  const double column_radius_m = Eigen::Vector3d(kCell_m, kCell_m, kTallest_m).norm() / 2.0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Eigen::Vector3d middle(middle_of(static_cast<int>(c) % kColumnsAcross),
                                 middle_of(static_cast<int>(c) / kColumnsAcross), 0.5 * kTallest_m);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const Ball& ball = objects[i].bound;
      const double reach_m = ball.radius_m + column_radius_m + lamp_.radius_m;
      if (!objects[i].obstructs) continue;
      if (to_segment(ball.centre, middle, lamp_.middle) > reach_m) continue;
      columns_[c].push_back(static_cast<std::uint16_t>(i));
    }
  }
}

const StillShadows::Column& StillShadows::column_at(const Eigen::Vector3d& p_world) const {
  const int cell = cell_of(p_world.y()) * kColumnsAcross + cell_of(p_world.x());
  return columns_[static_cast<std::size_t>(cell)];
}

double StillShadows::visible_share(const Eigen::Vector3d& p_world,
                                   const Eigen::Vector3d& normal) const {
  return host_sim::visible_share(lamp_, p_world + kOffSurface_m * normal, objects_,
                                 column_at(p_world));
}

}  // namespace dottrack::host_sim
