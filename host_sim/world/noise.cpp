#include "host_sim/world/noise.h"

#include <cmath>

#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

double at_lattice(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  const auto word = mix(seed ^ (static_cast<std::uint64_t>(x) * 0x8DA6B343ULL) ^
                        (static_cast<std::uint64_t>(y) * 0xD8163841ULL << 16U) ^
                        (static_cast<std::uint64_t>(z) * 0xCB1AB31FULL << 32U));
  return 2.0 * unit_interval(word) - 1.0;
}

double ease(double t) {
  return t * t * (3.0 - 2.0 * t);
}
double blend(double a, double b, double t) {
  return a + (b - a) * t;
}

double in_layer(const Eigen::Vector2d& p, std::int64_t z, std::uint64_t seed) {
  const double floor_x = std::floor(p.x());
  const double floor_y = std::floor(p.y());
  const auto x = static_cast<std::int64_t>(floor_x);
  const auto y = static_cast<std::int64_t>(floor_y);
  const double u = ease(p.x() - floor_x);
  const double v = ease(p.y() - floor_y);
  const double low = blend(at_lattice(x, y, z, seed), at_lattice(x + 1, y, z, seed), u);
  const double high = blend(at_lattice(x, y + 1, z, seed), at_lattice(x + 1, y + 1, z, seed), u);
  return blend(low, high, v);
}

}  // namespace

double value_noise(const Eigen::Vector2d& p, std::uint64_t seed) {
  return in_layer(p, 0, seed);
}

double value_noise(const Eigen::Vector3d& p, std::uint64_t seed) {
  const double floor_z = std::floor(p.z());
  const auto z = static_cast<std::int64_t>(floor_z);
  const Eigen::Vector2d xy = p.head<2>();
  return blend(in_layer(xy, z, seed), in_layer(xy, z + 1, seed), ease(p.z() - floor_z));
}

double fractal_noise(const Eigen::Vector2d& p, int octaves, std::uint64_t seed) {
  double sum = 0.0;
  double total = 0.0;
  double amplitude = 1.0;
  double frequency = 1.0;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude *
           value_noise(Eigen::Vector2d(p * frequency), seed + static_cast<std::uint64_t>(i));
    total += amplitude;
    amplitude *= 0.5;
    frequency *= 2.0;
  }
  return sum / total;
}

}  // namespace dottrack::host_sim
