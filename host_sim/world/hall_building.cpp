// Floor, walls, doors, ducts, and the light fixtures.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "host_sim/world/hall_parts.h"
#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWall_m = 0.2;       // thickness
constexpr double kMaxEmission = 8.0;  // diffusers are not looked at squarely by any camera

const Material kMetal{0.50, Pattern::plain, 0.45};
const Material kFrame{0.22, Pattern::plain, 0.2};

// A box between two corners.
void add_block(Model& hall, const Vector3d& low, const Vector3d& high, const Material& material) {
  add(hall, box(0.5 * (low + high), high - low), material);
}

void add_floor(Model& hall, const HallSite& site) {
  const double x = site.half_length_m();
  const double y = site.half_width_m();
  const double north = site.north_m();
  const Material concrete{0.30, Pattern::concrete, 0.06, site.options.seed};
  add_block(hall, {site.west_m(), y, -0.2}, {site.east_m(), north, 0.0}, concrete);
  add_block(hall, {site.west_m(), -north, -0.2}, {site.east_m(), -y, 0.0}, concrete);
  add_block(hall, {site.west_m(), -y, -0.2}, {-x, y, 0.0}, concrete);
  add_block(hall, {x, -y, -0.2}, {site.east_m(), y, 0.0}, concrete);
}

// Where a wall stands: its foot's middle, on the inner face, and the way into the hall.
struct Wall {
  Vector2d middle;
  Vector2d inward;
  double length_m;
};

std::array<Wall, 4> walls(const HallSite& site) {
  const double between = 0.5 * (site.west_m() + site.east_m());
  const double length = site.east_m() - site.west_m();
  return {{{{between, site.north_m()}, {0.0, -1.0}, length},
           {{between, -site.north_m()}, {0.0, 1.0}, length},
           {{site.west_m(), 0.0}, {1.0, 0.0}, 2.0 * site.north_m()},
           {{site.east_m(), 0.0}, {-1.0, 0.0}, 2.0 * site.north_m()}}};
}

// A slab on a wall: from `along_m` (from its middle), `height_m` its middle, standing out by
// `out_m`.
void add_slab(Model& hall, const Wall& wall, double along_m, double height_m, double length_m,
              double tall_m, double out_m, const Material& material) {
  const Vector2d along(-wall.inward.y(), wall.inward.x());
  const Vector2d p = wall.middle + along_m * along + 0.5 * out_m * wall.inward;
  Pose pose;
  pose.position_m = {p.x(), p.y(), height_m};
  pose.rotation.col(0) = Vector3d(along.x(), along.y(), 0.0);
  pose.rotation.col(1) = Vector3d(-wall.inward.x(), -wall.inward.y(), 0.0);
  pose.rotation.col(2) = Vector3d::UnitZ();
  add(hall, box(pose, {length_m, std::abs(out_m), tall_m}), material);
}

void add_door(Model& hall, const Wall& wall, double along_m, RandomStream& random) {
  const double wide_m = random.uniform() < 0.4 ? 1.8 : 0.95;
  const Material leaf{random.uniform(0.12, 0.5), Pattern::plain, 0.1};
  add_slab(hall, wall, along_m, 1.07, wide_m + 0.16, 2.14, 0.03, kFrame);
  add_slab(hall, wall, along_m, 1.03, wide_m, 2.06, 0.05, leaf);
  add_slab(hall, wall, along_m + 0.4 * wide_m, 1.05, 0.12, 0.04, 0.10, kMetal);
  add_slab(hall, wall, along_m, 2.35, 0.5, 0.18, 0.03, {0.75});  // the sign above it
}

// Panels in different paints, with doors, notices and trunking on them.
void add_wall(Model& hall, const HallSite& site, const Wall& wall, RandomStream& random) {
  const int panels = std::max(1, static_cast<int>(wall.length_m / 3.6));
  const double panel_m = wall.length_m / panels;
  const double shade = random.uniform(0.22, 0.58);
  const double top_m = site.options.height_m;
  for (int i = 0; i < panels; ++i) {
    const double along_m = (i + 0.5) * panel_m - 0.5 * wall.length_m;
    const Material upper{shade * random.uniform(0.85, 1.15), Pattern::plain, 0.03};
    const Material lower{0.6 * upper.albedo, Pattern::plain, 0.08};
    add_slab(hall, wall, along_m, 0.5 * (top_m + 1.2), panel_m - 0.01, top_m - 1.2, -kWall_m,
             upper);
    add_slab(hall, wall, along_m, 0.6, panel_m, 1.2, -kWall_m, lower);
    const double what = random.uniform();
    if (what < 0.25) add_door(hall, wall, along_m, random);
    if (what > 0.55) {
      const Vector2d at{along_m + random.uniform(-1.0, 1.0), random.uniform(1.4, 1.9)};
      const Vector2d size{random.uniform(0.2, 0.7), random.uniform(0.2, 0.6)};
      add_slab(hall, wall, at.x(), at.y(), size.x(), size.y(), 0.01, {random.uniform(0.5, 0.88)});
    }
  }
  add_slab(hall, wall, 0.0, 3.25, wall.length_m - 0.4, 0.08, 0.06, {0.55, Pattern::plain, 0.2});
}

void add_duct(Model& hall, const Vector3d& from, const Vector3d& to, double radius_m) {
  const Vector3d along = (to - from).normalized();
  const double length_m = (to - from).norm();
  add(hall, cylinder(from, along, length_m, radius_m, 24), kMetal);
  double at_m = 0.6;
  while (at_m < length_m) {
    add(hall, cylinder(from + at_m * along, along, 0.05, radius_m + 0.02, 24), kFrame);
    at_m += 1.8;
  }
}

// Along the walls, and across under the roof.
void add_ducts(Model& hall, const HallSite& site) {
  const double west = site.west_m() + 0.3;
  const double east = site.east_m() - 0.3;
  const double top = site.options.height_m;
  const double aside = site.north_m() - 0.4;
  add_duct(hall, {west, aside, top - 0.35}, {east, aside, top - 0.35}, 0.26);
  add_duct(hall, {west, -aside, top - 0.30}, {east, -aside, top - 0.30}, 0.20);
  for (const double x : {-0.21, 0.25}) {
    const double at = x * site.options.length_m;
    add_duct(hall, {at, -aside, top - 0.1}, {at, aside, top - 0.1}, 0.09);
  }
  for (const double x : {-0.44, 0.02, 0.40}) {  // down the southern wall
    const double at = x * site.options.length_m;
    add_duct(hall, {at, -site.north_m() + 0.16, 0.0}, {at, -site.north_m() + 0.16, top - 0.3},
             0.11);
  }
}

// The lamp's axes: u, v, the way it shines.
Pose frame_of(const Lamp& lamp) {
  Pose pose;
  pose.position_m = lamp.position_m;
  pose.rotation.col(0) = lamp.half_u_m.normalized();
  pose.rotation.col(2) = lamp.half_u_m.cross(lamp.half_v_m).normalized();
  pose.rotation.col(1) = pose.rotation.col(2).cross(pose.rotation.col(0));
  return pose;
}

// What is seen of a lamp, just behind the parallelogram that shines.
void add_pane(Model& hall, const Lamp& lamp, int index) {
  const double u = lamp.half_u_m.norm();
  const double v = lamp.half_v_m.norm();
  Pose pose = frame_of(lamp);
  pose.position_m = pose.to_world({0.0, 0.0, -0.016});
  Material pane{0.7, Pattern::plain, 0.3};
  // A Lambertian emitter of this strength: radiance of a white surface is irradiance over pi.
  pane.emission = std::min(kPi * lamp.strength / (4.0 * u * v), kMaxEmission);
  pane.lamp = index;
  add(hall, box(pose, {2.0 * u, 2.0 * v, 0.02}), pane);
}

void add_fixture(Model& hall, const Lamp& lamp) {
  const double u = lamp.half_u_m.norm();
  const double v = lamp.half_v_m.norm();
  Pose pose = frame_of(lamp);
  pose.position_m = pose.to_world({0.0, 0.0, -0.07});
  add(hall, box(pose, {2.0 * u + 0.08, 2.0 * v + 0.08, 0.08}), {0.6, Pattern::plain, 0.2});
}

void add_window_frame(Model& hall, const Lamp& lamp) {
  const double u = lamp.half_u_m.norm();
  const double v = lamp.half_v_m.norm();
  const Pose pane = frame_of(lamp);
  const auto bar = [&](const Vector3d& middle, const Vector3d& size) {
    Pose pose = pane;
    pose.position_m = pane.to_world(middle);
    add(hall, box(pose, size), kFrame);
  };
  for (const double side : {-1.0, 1.0}) {
    bar({0.0, side * (v + 0.04), 0.0}, {2.0 * u + 0.16, 0.08, 0.1});
    bar({side * (u + 0.04), 0.0, 0.0}, {0.08, 2.0 * v, 0.1});
  }
  bar({0.0, 0.0, -0.008}, {0.05, 2.0 * v, 0.014});
  bar({0.0, 0.1, -0.008}, {2.0 * u, 0.04, 0.014});
}

}  // namespace

void add_building(Model& hall, const HallSite& site) {
  RandomStream random(site.options.seed, 0x3A11);
  add_floor(hall, site);
  for (const Wall& wall : walls(site)) add_wall(hall, site, wall, random);
  add_ducts(hall, site);
}

void add_lights(Model& hall, const HallSite& site) {
  for (std::size_t i = 0; i < site.lamps.size(); ++i) {
    const Lamp& lamp = site.lamps[i];
    const bool tube = lamp.group.starts_with("fluorescent");
    const bool window = lamp.group.starts_with("window");
    if (!tube && !window) continue;
    add_pane(hall, lamp, static_cast<int>(i));
    if (tube) add_fixture(hall, lamp);
    if (window) add_window_frame(hall, lamp);
  }
}

}  // namespace dottrack::host_sim
