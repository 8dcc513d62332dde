#include "host_sim/renderer/vehicle_view.h"

#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr double kOffSurface_m = 1e-3;
constexpr int kMargin_px = 8;  // straight edges bow outwards between the points that are projected

// Points all over a box, in its own coordinates.
std::vector<Vector3d> points_of_box(const Vector3d& low, const Vector3d& high) {
  std::vector<Vector3d> points;
  for (const double a : {0.0, 0.5, 1.0}) {
    for (const double b : {0.0, 0.5, 1.0}) {
      for (const double c : {0.0, 0.5, 1.0}) {
        points.push_back(low + Vector3d(a, b, c).cwiseProduct(high - low));
      }
    }
  }
  return points;
}

// Where the line from the lamp through p meets the ground.
Vector3d shadow_of(const Vector3d& p, const Vector3d& lamp) {
  return p + (p - lamp) * (p.z() / (lamp.z() - p.z()));
}

PixelBox whole(const SimCamera& camera) {
  return {0, 0, camera.width_px(), camera.height_px()};
}

// How much of the sky a point of the ground at this distance from under the body still sees.
double open_sky(double distance_m) {
  const double q = distance_m / 0.20;
  const double dark = 1.0 / (1.0 + q * q);
  return 1.0 - 0.6 * dark * dark;
}

PixelBox reach_of(const Vehicle& vehicle, const Pose& pose, const Vector3d& lamp,
                  const SimCamera& camera) {
  Eigen::Vector2d low(1e5, 1e5);
  Eigen::Vector2d high(-1e5, -1e5);
  for (const Vector3d& p_body : points_of_box(vehicle.box_min_m, vehicle.box_max_m)) {
    const Vector3d p = pose.to_world(p_body);
    for (const Vector3d& q : {p, shadow_of(p, lamp)}) {
      const auto pixel = camera.project(q);
      if (!pixel) return whole(camera);
      low = low.cwiseMin(*pixel).cwiseMax(-1e5);
      high = high.cwiseMax(*pixel).cwiseMin(1e5);
    }
  }
  const PixelBox box{static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())),
                     static_cast<int>(std::ceil(high.x())) + 1,
                     static_cast<int>(std::ceil(high.y())) + 1};
  return grown(box, kMargin_px, camera.width_px(), camera.height_px());
}

}  // namespace

VehicleView::VehicleView(const Vehicle& vehicle, const Pose& pose, const Lighting& lighting,
                         const LampDisc& lamp, const SimCamera& camera, const RayLattice& rays)
    : vehicle_(vehicle),
      pose_(pose),
      lighting_(lighting),
      camera_(camera),
      reach_(reach_of(vehicle, pose, lighting.key.position_m, camera)),
      lamp_body_(to_body(lamp, pose)),
      objects_(vehicle.objects, pose.to_body(camera.centre_m()), reach_, [&](int x, int y) {
        return Vector3d(pose.rotation.transpose() * rays.corner(x, y));
      }) {
  for (std::size_t i = 0; i < vehicle.objects.size(); ++i) {
    if (vehicle.objects[i].obstructs) shadow_casters_.push_back(static_cast<std::uint16_t>(i));
  }
}

SurfaceHit VehicleView::cast(int x, int y, const Vector3d& direction) const {
  SurfaceHit result;
  Hit hit{result.distance, Vector3d::Zero()};
  const int object = objects_.nearest(x, y, pose_.rotation.transpose() * direction, hit);
  if (object >= 0) result.surface = kFirstVehicleObject + object;
  result.distance = hit.distance;
  result.normal = pose_.rotation * hit.normal;
  return result;
}

bool VehicleView::is_mark(int surface) const {
  return surface >= kFirstVehicleObject &&
         objects_[static_cast<std::size_t>(surface - kFirstVehicleObject)].is_mark;
}

double VehicleView::key_share(const Vector3d& p_world, const Vector3d& normal_world) const {
  const Vector3d from = pose_.to_body(p_world + kOffSurface_m * normal_world);
  return visible_share(lamp_body_, from, vehicle_.objects, shadow_casters_);
}

Radiance VehicleView::radiance(const Patch& patch) const {
  const Object& object = objects_[static_cast<std::size_t>(patch.surface - kFirstVehicleObject)];
  const Vector3d p = camera_.centre_m() + patch.distance * patch.direction;
  const double footprint_m = patch.distance * patch.direction.norm() / camera_.lens().focal_x_px;
  Radiance radiance = radiance_of(object.material, {p, pose_.to_body(p), patch.normal, footprint_m},
                                  lighting_, camera_.centre_m());
  if (radiance.key > 0.0) radiance.key *= key_share(p, patch.normal);
  return radiance;
}

VehicleView::Shade VehicleView::shade_on_ground(const Vector3d& p_world) const {
  const Vector3d p = pose_.to_body(p_world);
  const double dx =
      std::max({vehicle_.box_min_m.x() + 0.25 - p.x(), p.x() - vehicle_.box_max_m.x() + 0.25, 0.0});
  const double dy =
      std::max({vehicle_.box_min_m.y() + 0.30 - p.y(), p.y() - vehicle_.box_max_m.y() + 0.30, 0.0});
  return {key_share(p_world, Vector3d::UnitZ()), open_sky(std::sqrt(dx * dx + dy * dy))};
}

}  // namespace dottrack::host_sim
