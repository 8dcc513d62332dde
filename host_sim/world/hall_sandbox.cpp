// What is inside the boards, and the boards.

#include <algorithm>
#include <cmath>

#include "host_sim/world/hall_parts.h"
#include "host_sim/world/look_alikes.h"
#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A row of boards, each short, from `middle` to both sides along x or y.
void add_boards(Model& hall, const Vector3d& middle, int axis, double length_m) {
  const int pieces = static_cast<int>(std::ceil(length_m / 2.4));
  const double piece_m = length_m / pieces;
  Vector3d size(kBoard_m, kBoard_m, kBoardTop_m + 0.2);
  size[axis] = piece_m - 0.006;
  for (int i = 0; i < pieces; ++i) {
    const Vector3d at = middle + ((i + 0.5) * piece_m - 0.5 * length_m) * Vector3d::Unit(axis);
    const double albedo = 0.30 + 0.05 * (i % 3);
    add(hall, box(at, size), {albedo, Pattern::planks, 0.0, 9});
  }
}

// A ramp's surface as far as it is rounded, and straight from there on.
void add_ramp(Model& hall, const Terrain& terrain) {
  const Ramp& ramp = *terrain.ramp();
  const double reach_m = ramp.length_m * cosine(ramp.angle_rad);
  const Pose pose = upright({ramp.foot_m.x(), ramp.foot_m.y(), 0.0}, ramp.heading_rad);
  std::vector<Vector2d> side;  // along, height
  for (int i = 0; i <= 8; ++i)
    side.emplace_back(-0.2 + 0.05 * i, terrain.ramp_height_m(-0.2 + 0.05 * i));
  side.emplace_back(reach_m, terrain.ramp_height_m(reach_m));
  side.emplace_back(reach_m, -0.05);
  side.emplace_back(-0.2, -0.05);
  std::reverse(side.begin(), side.end());
  // A prism stands upright; this one lies on its side, its own z to the ramp's right.
  Pose lying;
  lying.rotation << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  TriangleMesh mesh = transformed(prism(side, -0.5 * ramp.width_m, 0.5 * ramp.width_m), lying);
  add(hall, transformed(std::move(mesh), pose), {0.33, Pattern::planks, 0.05, 17});
}

void add_rocks(Model& hall, const HallSite& site, GroundPlan& plan) {
  RandomStream random(site.options.seed, 2);
  for (int i = 0; i < site.options.rocks; ++i) {
    const double size = random.uniform();
    const double radius_m = 0.045 + 0.33 * size * size * size * size;
    const double albedo = random.uniform(0.15, 0.30);
    const std::uint64_t shape = random.word();
    const auto place = plan.find_on_sand(random, radius_m, kVehicleReach_m + radius_m);
    if (!place) continue;
    Pose pose = lying_on(site.terrain, *place, random.uniform(0.0, 2.0 * kPi));
    pose.position_m.z() += 0.15 * radius_m;
    add(hall, transformed(rock(shape, radius_m), pose), {albedo, Pattern::mottled, 0.0, shape});
  }
}

void add_look_alikes(Model& hall, const HallSite& site, GroundPlan& plan) {
  RandomStream random(site.options.seed, 4);
  for (int i = 0; i < site.options.look_alikes; ++i) {
    const Model thing = make_look_alike(random.word());
    const auto place = plan.find_on_sand(random, 0.3, kVehicleReach_m + 0.3);
    if (!place) continue;
    append(hall, thing, lying_on(site.terrain, *place, random.uniform(0.0, 2.0 * kPi)));
  }
}

}  // namespace

void add_sandbox(Model& hall, const HallSite& site) {
  const double x = site.half_length_m();
  const double y = site.half_width_m();
  add(hall,
      heightfield([&](const Vector2d& p) { return site.terrain.sand_height_m(p); }, {-x, x},
                  {-y, y}, 0.1),
      {0.37, Pattern::sand, 0.0, site.options.seed});
  const double middle_z = 0.5 * (kBoardTop_m - 0.2);
  const double off = 0.5 * kBoard_m;
  for (const double side : {-1.0, 1.0}) {
    add_boards(hall, {0.0, side * (y + off), middle_z}, 0, 2.0 * x + 2.0 * kBoard_m);
    add_boards(hall, {side * (x + off), 0.0, middle_z}, 1, 2.0 * y);
  }
  if (site.terrain.ramp()) add_ramp(hall, site.terrain);
}

void add_rocks_and_look_alikes(Model& hall, const HallSite& site, GroundPlan& plan) {
  add_rocks(hall, site, plan);
  add_look_alikes(hall, site, plan);
}

}  // namespace dottrack::host_sim
