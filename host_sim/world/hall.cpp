#include "host_sim/world/hall.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/hall_parts.h"
#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;

constexpr int kAttempts = 200;  // to find room for one thing
constexpr double kLander_m = 1.35;

void add_lander(Model& hall, const HallSite& site, GroundPlan& plan) {
  RandomStream random(site.options.seed, 0x1A4D);
  const auto place = plan.find_on_sand(random, kLander_m, kVehicleReach_m + kLander_m);
  // Where the drive leaves it no room on the sand it stands in the bay.
  const Vector2d in_bay(site.half_length_m() + 6.5, 0.0);
  if (!place) plan.take(in_bay, kLander_m);
  const Pose pose = lying_on(site.terrain, place.value_or(in_bay), random.uniform(0.0, 2.0 * kPi));
  append(hall, make_lander(random.word()), pose);
}

}  // namespace

bool GroundPlan::is_free(const Vector2d& middle, double radius_m) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Circle& c) {
    return (c.middle - middle).norm() < c.radius_m + radius_m + 0.04;
  });
}

bool GroundPlan::is_on_ramp(const Vector2d& middle, double radius_m) const {
  const auto& ramp = site_.terrain.ramp();
  if (!ramp) return false;
  const Vector2d q = site_.terrain.in_ramp(middle);
  return q.x() > -0.4 - radius_m && q.x() < ramp->length_m + radius_m &&
         std::abs(q.y()) < 0.5 * ramp->width_m + 0.1 + radius_m;
}

std::optional<Vector2d> GroundPlan::find_on_sand(RandomStream& random, double radius_m,
                                                 double clear_m) {
  const auto& in_the_way = site_.options.distance_to_drive_m;
  const Vector2d half(site_.half_length_m() - radius_m - 0.08,
                      site_.half_width_m() - radius_m - 0.08);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Vector2d place{half.x() * random.uniform(-1.0, 1.0),
                         half.y() * random.uniform(-1.0, 1.0)};
    if (!is_free(place, radius_m) || is_on_ramp(place, radius_m)) continue;
    if (in_the_way && in_the_way(place) < clear_m) continue;
    take(place, radius_m);
    return place;
  }
  return std::nullopt;
}

Pose lying_on(const Terrain& terrain, const Vector2d& place, double yaw_rad) {
  Pose pose = facing({place.x(), place.y(), terrain.height_m(place)}, terrain.normal(place));
  pose.rotation = pose.rotation * upright(Eigen::Vector3d::Zero(), yaw_rad).rotation;
  return pose;
}

Model make_hall(const HallOptions& options, const Terrain& terrain, std::span<const Lamp> lamps) {
  const HallSite site{options, terrain, lamps};
  GroundPlan plan(site);
  Model hall;
  add_calibration_dots(hall, site, plan);
  add_building(hall, site);
  add_lights(hall, site);
  add_sandbox(hall, site);
  if (options.lander) add_lander(hall, site, plan);
  add_rocks_and_look_alikes(hall, site, plan);
  if (options.furniture) add_furniture(hall, site, plan);
  return hall;
}

}  // namespace dottrack::host_sim
