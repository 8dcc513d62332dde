#include "host_sim/scenarios/scenes.h"

#include <algorithm>
#include <vector>

#include "host_sim/scenarios/ceiling.h"
#include "host_sim/world/clutter.h"
#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;

constexpr double kHalfLength_m = 4.0;
constexpr double kHalfWidth_m = 3.0;

// Where the vehicle comes in the first `duration_s`.
std::vector<Vector2d> places_on(const DrivePath& drive, double duration_s) {
  constexpr int kPlaces = 160;
  std::vector<Vector2d> places;
  for (int i = 0; i <= kPlaces; ++i) {
    places.push_back(pose_at(drive, duration_s * i / kPlaces).position_m.head<2>());
  }
  return places;
}

void furnish(World& world, ClutterOptions options, double driving_s) {
  const std::vector<Vector2d> places =
      world.vehicle ? places_on(world.drive, driving_s) : std::vector<Vector2d>{};
  options.half_length_m = kHalfLength_m;
  options.half_width_m = kHalfWidth_m;
  options.distance_to_drive_m = [&places](const Vector2d& p) {
    double least = 1e9;
    for (const Vector2d& place : places) least = std::min(least, (place - p).norm());
    return least;
  };
  world.objects = make_hall(kHalfLength_m, kHalfWidth_m);
  for (Object& object : make_clutter(options)) world.objects.push_back(std::move(object));
}

World empty_hall(std::uint64_t seed) {
  World world;
  world.ground = {kHalfLength_m, kHalfWidth_m, mix(seed, 0x5A4D), {}};
  world.lighting = hall_lighting(seed);
  return world;
}

}  // namespace

Scene make_demo_scene(std::uint64_t seed) {
  Scene scene;
  scene.name = "sandbox";
  scene.seed = seed;
  scene.world = empty_hall(seed);
  scene.target = demo_layout();
  scene.world.vehicle = make_rover(scene.target);
  scene.world.drive.phase_rad = RandomStream(seed, 0xD1).uniform(0.0, 2.0 * kPi);
  const double round_s = 2.0 * kPi / scene.world.drive.rate_rad_s;
  scene.world.ground.trail = {scene.world.drive, -round_s, 0.0, kHalfTrack_m, kWheelWidth_m};
  ClutterOptions clutter;
  clutter.seed = seed;
  furnish(scene.world, clutter, round_s);
  CeilingOptions ceiling;
  ceiling.seed = seed;
  scene.cameras = ceiling_cameras(ceiling);
  return scene;
}

Scene make_random_scene(const RandomSceneOptions& options) {
  RandomStream random(options.seed, 0x5CE);
  Scene scene;
  scene.name = "random";
  scene.seed = options.seed;
  scene.world = empty_hall(options.seed);
  scene.target = random_layout(options.dots, options.seed);
  if (options.with_vehicle) scene.world.vehicle = make_rover(scene.target);
  const Vector2d start{random.uniform(-2.4, 2.4), random.uniform(-1.6, 1.6)};
  scene.world.drive = starting_at({}, start, random.uniform(-kPi, kPi));
  furnish(scene.world,
          {.seed = options.seed,
           .look_alikes = options.look_alikes,
           .rocks = options.rocks,
           .boxes = options.boxes,
           .distance_to_drive_m = {}},
          2.0);
  scene.cameras = ceiling_cameras({.seed = options.seed,
                                   .cameras = options.cameras,
                                   .width_px = options.width_px,
                                   .height_px = options.height_px});
  return scene;
}

}  // namespace dottrack::host_sim
