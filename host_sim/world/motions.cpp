#include "host_sim/world/motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "host_sim/world/meshes.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/rover.h"
#include "host_sim/world/smooth_curve.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array<std::array<double, 2>, 6> kWheels = {{{kHalfWheelBase_m, kHalfTrack_m},
                                                           {kHalfWheelBase_m, -kHalfTrack_m},
                                                           {0.0, kHalfTrack_m},
                                                           {0.0, -kHalfTrack_m},
                                                           {-kHalfWheelBase_m, kHalfTrack_m},
                                                           {-kHalfWheelBase_m, -kHalfTrack_m}}};

// A plane over (way forward, way left) of a point.
struct Plane {
  double height_m = 0.0;
  double forward_slope = 0.0;
  double left_slope = 0.0;
};

Pose on_plane(const Vector2d& position_m, const Vector2d& forward, const Plane& plane) {
  const Vector2d left(-forward.y(), forward.x());
  const Vector2d fall = -plane.forward_slope * forward - plane.left_slope * left;
  Pose pose;
  pose.position_m = {position_m.x(), position_m.y(), plane.height_m};
  pose.rotation.col(0) = Vector3d(forward.x(), forward.y(), plane.forward_slope).normalized();
  pose.rotation.col(2) = Vector3d(fall.x(), fall.y(), 1.0).normalized();
  pose.rotation.col(1) = pose.rotation.col(2).cross(pose.rotation.col(0));
  return pose;
}

// Least squares over the wheels of what is between them and the ground.
Plane fit_to_ground(const Terrain& terrain, const Pose& pose) {
  Plane fit;
  for (const auto& [x, y] : kWheels) {
    const Vector3d wheel = pose.to_world({x, y, 0.0});
    const double gap_m = terrain.height_m(wheel.head<2>()) - wheel.z();
    fit.height_m += gap_m / 6.0;
    fit.forward_slope += gap_m * x / (4.0 * kHalfWheelBase_m * kHalfWheelBase_m);
    fit.left_slope += gap_m * y / (6.0 * kHalfTrack_m * kHalfTrack_m);
  }
  return fit;
}

Pose settled(const Terrain& terrain, const Vector2d& position_m, const Vector2d& forward) {
  Plane plane;
  // The tilt moves the wheels a little, so a few rounds; their number is fixed to stay smooth.
  for (int round = 0; round < 5; ++round) {
    const Plane fit = fit_to_ground(terrain, on_plane(position_m, forward, plane));
    plane.height_m += fit.height_m;
    plane.forward_slope += fit.forward_slope;
    plane.left_slope += fit.left_slope;
  }
  return on_plane(position_m, forward, plane);
}

double way_m(const SmoothCurve& curve, double speed_m_s, bool closed, double time_s) {
  const double way = speed_m_s * std::max(time_s, 0.0);
  return closed ? way : std::min(way, curve.length_m());
}

Pose walking(const Terrain& terrain, const SmoothCurve::Place& place, double way_m) {
  constexpr double kStep_m = 0.70;
  constexpr double kBob_m = 0.02;
  constexpr double kSway_m = 0.025;
  constexpr double kLean = 0.03;  // rad
  const double swing = sine(kPi * way_m / kStep_m);
  const Vector2d left(-place.forward.y(), place.forward.x());
  const Vector2d at = place.position_m + kSway_m * swing * left;
  Plane plane;
  plane.height_m = terrain.height_m(place.position_m) + kBob_m * (swing * swing - 1.0);
  plane.left_slope = -kLean * swing;
  return on_plane(at, place.forward, plane);
}

}  // namespace

double path_length_m(const WayPoints& way_points, bool closed) {
  return SmoothCurve(way_points, closed).length_m();
}

double distance_to_path_m(const WayPoints& way_points, bool closed, const Vector2d& p) {
  return SmoothCurve(way_points, closed).distance_m(p);
}

Pose placed_on(const Terrain& terrain, const Vector2d& position_m, double yaw_rad) {
  return settled(terrain, position_m, {cosine(yaw_rad), sine(yaw_rad)});
}

Motion drive_along(const Terrain& terrain, const WayPoints& way_points, double speed_m_s,
                   bool closed) {
  const auto curve = std::make_shared<const SmoothCurve>(way_points, closed);
  return [=](double time_s) -> std::optional<Pose> {
    const auto place = curve->at(way_m(*curve, speed_m_s, closed, time_s));
    return settled(terrain, place.position_m, place.forward);
  };
}

Motion walk(const Terrain& terrain, const WayPoints& way_points, double speed_m_s, bool closed) {
  const auto curve = std::make_shared<const SmoothCurve>(way_points, closed);
  return [=](double time_s) -> std::optional<Pose> {
    const double way = way_m(*curve, speed_m_s, closed, time_s);
    return walking(terrain, curve->at(way), way);
  };
}

Motion stand_at(const Pose& pose) {
  return [pose](double) -> std::optional<Pose> { return pose; };
}

Motion survey_places(std::vector<Pose> places, double dwell_s) {
  const auto shared = std::make_shared<const std::vector<Pose>>(std::move(places));
  return [=](double time_s) -> std::optional<Pose> {
    if (shared->empty()) return std::nullopt;
    const double last = static_cast<double>(shared->size() - 1);
    return (*shared)[static_cast<std::size_t>(std::clamp(std::floor(time_s / dwell_s), 0.0, last))];
  };
}

Motion switched(std::vector<std::pair<double, Motion>> motions) {
  const auto shared =
      std::make_shared<const std::vector<std::pair<double, Motion>>>(std::move(motions));
  return [=](double time_s) -> std::optional<Pose> {
    const auto next = std::find_if(shared->begin(), shared->end(),
                                   [&](const auto& entry) { return entry.first > time_s; });
    if (next == shared->begin()) return std::nullopt;
    const Motion& motion = std::prev(next)->second;
    return motion ? motion(time_s) : std::nullopt;
  };
}

}  // namespace dottrack::host_sim
