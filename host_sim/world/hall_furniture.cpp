// Where furniture stands: along the walls, and in the bay at the end of the hall.

#include <algorithm>
#include <cmath>

#include "host_sim/world/furniture.h"
#include "host_sim/world/hall_parts.h"
#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Piece {
  Model model;
  double radius_m;  // of the ground that it takes
};

Piece against_wall(RandomStream& random) {
  const double kind = random.uniform();
  const std::uint64_t seed = random.word();
  if (kind < 0.30) return {make_cabinet(seed), 0.48};
  if (kind < 0.48) return {make_table(seed), 0.70};
  if (kind < 0.60) return {make_tool_chest(seed), 0.42};
  if (kind < 0.70) return {make_chair(seed), 0.33};
  if (kind < 0.80) return {make_covered_heap(seed), 0.60};
  if (kind < 0.90) return {make_bin(seed), 0.28};
  return {make_stand(seed), 0.36};
}

void place(Model& hall, GroundPlan& plan, const Piece& piece, const Vector2d& at, double yaw_rad) {
  if (!plan.is_free(at, piece.radius_m)) return;
  plan.take(at, piece.radius_m);
  append(hall, piece.model, upright({at.x(), at.y(), 0.0}, yaw_rad));
}

// Fronts to the sandbox.
void furnish_aisles(Model& hall, const HallSite& site, GroundPlan& plan, RandomStream& random) {
  const double reach = 0.38;  // from the wall to the middle of a piece
  const double north = site.north_m() - reach;
  double x = site.west_m() + 0.7;
  while (x < site.half_length_m()) {
    const Piece left = against_wall(random);
    const Piece right = against_wall(random);
    place(hall, plan, left, {x, north}, random.uniform(-0.06, 0.06));
    place(hall, plan, right, {x, -north}, kPi + random.uniform(-0.06, 0.06));
    x += random.uniform(0.15, 0.5);
  }
  const double west = site.west_m() + reach;
  double y = -site.half_width_m();
  while (y < site.half_width_m()) {
    const Piece piece = against_wall(random);
    place(hall, plan, piece, {west, y}, 0.5 * kPi + random.uniform(-0.06, 0.06));
    y += random.uniform(0.2, 0.6);
  }
}

// Nothing tall near the sand: the sun comes from there.
void furnish_bay(Model& hall, const HallSite& site, GroundPlan& plan, RandomStream& random) {
  const double near = site.half_length_m() + 1.4;
  const double far = site.east_m() - 0.7;
  const Vector2d platform{site.half_length_m() + 2.6, random.uniform(-2.5, 2.5)};
  place(hall, plan, {make_raised_floor(random.word()), 1.5}, platform, 0.5 * kPi);
  for (int i = 0; i < 90; ++i) {
    const Piece piece = against_wall(random);
    const Vector2d at{random.uniform(near, far), random.uniform(-0.9, 0.9) * site.north_m()};
    const double yaw_rad = random.uniform(0.0, 2.0 * kPi);
    place(hall, plan, piece, at, yaw_rad);
  }
}

void scatter_tools(Model& hall, const HallSite& site, GroundPlan& plan, RandomStream& random) {
  for (int i = 0; i < 60; ++i) {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    Vector2d at{random.uniform(-1.0, 1.0) * site.half_length_m(),
                side * (site.half_width_m() + random.uniform(0.2, 0.8))};
    if (i % 4 == 0) at = {site.half_length_m() + random.uniform(0.3, 2.0), 0.9 * at.y()};
    if (i % 4 == 1) at = {site.west_m() + random.uniform(0.75, 1.3), 0.9 * at.y()};
    const double yaw_rad = random.uniform(0.0, 2.0 * kPi);
    place(hall, plan, {make_hand_tool(random.word()), 0.15}, at, yaw_rad);
  }
}

// A cable that somebody laid along the aisle, `from` to `to`, in bends.
Cable laid_cable(const Vector2d& from, const Vector2d& to, RandomStream& random) {
  const double radius_m = random.uniform(0.006, 0.014);
  const int points = 3 + static_cast<int>((to - from).norm() / 0.25);
  const Vector2d along = (to - from).normalized();
  const Vector2d aside(-along.y(), along.x());
  double off_m = 0.0;
  Cable cable;
  for (int i = 0; i <= points; ++i) {
    off_m = 0.75 * off_m + random.uniform(-0.10, 0.10);
    const Vector2d p = from + (to - from) * i / points + off_m * aside;
    cable.path.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(radius_m), static_cast<float>(radius_m));
  }
  return cable;
}

void lay_cables(Model& hall, const HallSite& site, RandomStream& random) {
  const double x = site.half_length_m();
  const double y = site.half_width_m() + 0.45;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 3; ++i) {
      const Vector2d from{random.uniform(-1.0, 0.2) * x, side * (y + random.uniform(-0.1, 0.2))};
      const Vector2d to{from.x() + random.uniform(3.0, 9.0),
                        side * (y + random.uniform(-0.1, 0.2))};
      const Material rubber{random.uniform() < 0.7 ? 0.06 : 0.6, Pattern::plain, 0.1};
      add(hall, laid_cable(from, to, random), rubber);
    }
  }
  add(hall, laid_cable({x + 0.6, -0.9 * y}, {x + 0.8, 0.8 * y}, random), {0.7});
}

}  // namespace

void add_furniture(Model& hall, const HallSite& site, GroundPlan& plan) {
  RandomStream random(site.options.seed, 0xF0);
  furnish_aisles(hall, site, plan, random);
  furnish_bay(hall, site, plan, random);
  scatter_tools(hall, site, plan, random);
  lay_cables(hall, site, random);
}

}  // namespace dottrack::host_sim
