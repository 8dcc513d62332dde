#include "host_sim/world/material.h"

#include <algorithm>
#include <cmath>

#include "host_sim/world/noise.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

// How much of a window of the given width around x lies on lines of `line_m`, every `period_m`.
double line_share(double x, double period_m, double line_m, double window_m) {
  const double phase = x - period_m * std::floor(x / period_m + 0.5);  // distance to a line
  const double low = std::max(phase - 0.5 * window_m, -0.5 * line_m);
  const double high = std::min(phase + 0.5 * window_m, 0.5 * line_m);
  return std::clamp((high - low) / window_m, 0.0, 1.0);
}

double mottled(const Material& m, const Eigen::Vector3d& p) {
  const double coarse = value_noise(Eigen::Vector3d(p / 0.11), m.seed);
  const double fine = value_noise(Eigen::Vector3d(p / 0.025), m.seed + 1);
  return m.albedo * (1.0 + 0.20 * coarse + 0.18 * fine);
}

double cells(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double along = line_share(p.x(), 0.080, 0.006, window_m);
  const double across = line_share(p.y(), 0.045, 0.004, window_m);
  const double seams = along + across - along * across;
  const double tone = value_noise(
      Eigen::Vector3d(std::floor(p.x() / 0.080 + 0.5), std::floor(p.y() / 0.045 + 0.5), 0.0),
      m.seed);
  return m.albedo * (1.0 + 0.12 * tone) + 0.13 * seams;
}

double planks(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double gaps = line_share(p.z() + 0.07, 0.14, 0.008, window_m);
  const double grain = value_noise(
      Eigen::Vector3d(p.x() * 2.0, p.y() * 2.0, std::floor(p.z() / 0.14) + 40.0 * p.z()), m.seed);
  return m.albedo * (1.0 + 0.10 * grain) * (1.0 - 0.6 * gaps);
}

double stripes(const Material& m, const Eigen::Vector3d& p, double window_m) {
  const double bright = line_share(p.x() + p.y() + p.z(), 0.24, 0.12, window_m);
  return m.albedo * (0.15 + 0.85 * bright);
}

// A pebble in some of the 10 cm cells: relative change of the albedo.
double pebble(const Eigen::Vector2d& p, std::uint64_t seed) {
  constexpr double kCell_m = 0.10;
  const Eigen::Vector2d cell(std::floor(p.x() / kCell_m), std::floor(p.y() / kCell_m));
  RandomStream random(mix(seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x()))),
                      static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y())));
  if (random.uniform() > 0.22) return 0.0;
  const Eigen::Vector2d middle{random.uniform(0.25, 0.75), random.uniform(0.25, 0.75)};
  const double radius_m = random.uniform(0.006, 0.018);
  const double change =
      random.uniform() < 0.75 ? random.uniform(-0.55, -0.2) : random.uniform(0.15, 0.45);
  return (p - kCell_m * (cell + middle)).squaredNorm() < radius_m * radius_m ? change : 0.0;
}

double sand(const Material& m, const Eigen::Vector2d& p) {
  const double sorts = 0.12 * fractal_noise(p / 2.1, 2, m.seed + 20);  // of sand, in large patches
  const double patches = 0.10 * fractal_noise(p / 0.7, 3, m.seed + 21);
  const double grain = 0.13 * value_noise(Eigen::Vector2d(p / 0.013), m.seed + 22);
  return m.albedo * (1.0 + sorts + patches + grain + pebble(p, m.seed + 23));
}

double concrete(const Material& m, const Eigen::Vector2d& p, double window_m) {
  const double stains = 0.14 * fractal_noise(p / 0.6, 4, m.seed + 31);
  const double along = line_share(p.x(), 1.2, 0.012, window_m);
  const double across = line_share(p.y(), 1.2, 0.012, window_m);
  return m.albedo * (1.0 + stains) * (1.0 - 0.4 * std::max(along, across));
}

// Footprints, hummocks and ripples of the sand, metres.
double sand_relief_m(const Eigen::Vector2d& p, std::uint64_t seed) {
  const double hummocks = 0.016 * fractal_noise(p / 0.35, 2, seed + 10);
  const double ripples =
      0.003 * value_noise(Eigen::Vector2d(p.x() / 0.08, p.y() / 0.17), seed + 11);
  return hummocks + ripples + 0.0015 * value_noise(Eigen::Vector2d(p / 0.022), seed + 12);
}

Eigen::Vector3d sand_slope(const Eigen::Vector2d& p, std::uint64_t seed) {
  constexpr double kStep_m = 0.008;
  const double here = sand_relief_m(p, seed);
  const double dx = sand_relief_m(p + Eigen::Vector2d(kStep_m, 0.0), seed) - here;
  const double dy = sand_relief_m(p + Eigen::Vector2d(0.0, kStep_m), seed) - here;
  return {dx / kStep_m, dy / kStep_m, 0.0};
}

Eigen::Vector3d stone_slope(const Eigen::Vector3d& p, std::uint64_t seed) {
  const Eigen::Vector3d q = p / 0.03;
  return 0.35 * Eigen::Vector3d(value_noise(q, seed + 51), value_noise(q, seed + 52),
                                value_noise(q, seed + 53));
}

}  // namespace

double albedo_at(const Material& material, const Eigen::Vector3d& p_body, double footprint_m) {
  const double window_m = std::max(footprint_m, 1e-4);
  switch (material.pattern) {
    case Pattern::plain:
      return material.albedo;
    case Pattern::mottled:
      return mottled(material, p_body);
    case Pattern::cells:
      return cells(material, p_body, window_m);
    case Pattern::planks:
      return planks(material, p_body, window_m);
    case Pattern::stripes:
      return stripes(material, p_body, window_m);
    case Pattern::sand:
      return sand(material, p_body.head<2>());
    case Pattern::concrete:
      return concrete(material, p_body.head<2>(), window_m);
  }
  return material.albedo;
}

Eigen::Vector3d relief_normal(const Material& material, const Eigen::Vector3d& p_body,
                              const Eigen::Vector3d& normal) {
  switch (material.pattern) {
    case Pattern::sand:
      return (normal - sand_slope(p_body.head<2>(), material.seed)).normalized();
    case Pattern::mottled:
      return (normal - stone_slope(p_body, material.seed)).normalized();
    case Pattern::plain:
    case Pattern::cells:
    case Pattern::planks:
    case Pattern::stripes:
    case Pattern::concrete:
      return normal;
  }
  return normal;
}

}  // namespace dottrack::host_sim
