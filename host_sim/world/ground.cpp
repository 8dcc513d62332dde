#include "host_sim/world/ground.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/noise.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

// Dunes, hummocks and ripples, metres.
double relief_m(const Eigen::Vector2d& p, std::uint64_t seed) {
  const double dunes = 0.045 * fractal_noise(p / 0.9, 2, seed);
  const double ripples =
      0.004 * value_noise(Eigen::Vector2d(p.x() / 0.05, p.y() / 0.16), seed + 11);
  return dunes + ripples + 0.0015 * value_noise(Eigen::Vector2d(p / 0.022), seed + 12);
}

// A pebble in some of the 10 cm cells: relative change of the albedo.
double pebble(const Eigen::Vector2d& p, std::uint64_t seed) {
  const double cell_m = 0.10;
  const Eigen::Vector2d cell(std::floor(p.x() / cell_m), std::floor(p.y() / cell_m));
  RandomStream random(mix(seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x()))),
                      static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y())));
  if (random.uniform() > 0.22) return 0.0;
  const Eigen::Vector2d middle{random.uniform(0.25, 0.75), random.uniform(0.25, 0.75)};
  const double radius_m = random.uniform(0.006, 0.018);
  const double change =
      random.uniform() < 0.75 ? random.uniform(-0.55, -0.2) : random.uniform(0.15, 0.45);
  return (p - cell_m * (cell + middle)).norm() < radius_m ? change : 0.0;
}

double sand_albedo(const Eigen::Vector2d& p, std::uint64_t seed) {
  const double patches = 0.10 * fractal_noise(p / 0.7, 3, seed + 21);
  const double grain = 0.13 * value_noise(Eigen::Vector2d(p / 0.013), seed + 22);
  return 0.40 * (1.0 + patches + grain + pebble(p, seed + 23));
}

double concrete_albedo(const Eigen::Vector2d& p, std::uint64_t seed) {
  const double stains = 0.12 * fractal_noise(p / 0.6, 4, seed + 31);
  const Eigen::Vector2d slab(p.x() - 1.2 * std::floor(p.x() / 1.2),
                             p.y() - 1.2 * std::floor(p.y() / 1.2));
  const bool joint = std::min(slab.x(), slab.y()) < 0.012;
  return 0.30 * (1.0 + stains) * (joint ? 0.6 : 1.0);
}

}  // namespace

bool Ground::is_sand(const Eigen::Vector2d& p) const {
  return std::abs(p.x()) <= half_length_m && std::abs(p.y()) <= half_width_m;
}

double Ground::albedo_at(const Eigen::Vector2d& p) const {
  return is_sand(p) ? sand_albedo(p, seed) * trail.factor_at(p) : concrete_albedo(p, seed);
}

Eigen::Vector3d Ground::normal_at(const Eigen::Vector2d& p) const {
  if (!is_sand(p)) return Eigen::Vector3d::UnitZ();
  const double step_m = 0.008;
  const double here = relief_m(p, seed);
  const double dx = relief_m(p + Eigen::Vector2d(step_m, 0.0), seed) - here;
  const double dy = relief_m(p + Eigen::Vector2d(0.0, step_m), seed) - here;
  return Eigen::Vector3d(-dx, -dy, step_m).normalized();
}

}  // namespace dottrack::host_sim
