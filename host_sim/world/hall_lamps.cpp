#include "host_sim/world/hall_lamps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host_sim/world/portable_math.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr int kColumns = 5;
constexpr double kFixture_m = 7.25;  // strength; with it and the bounce: 0.45 to 0.75 on the floor
constexpr double kFixtureBounce = 0.022;
constexpr double kSunDistance_m = 200.0;
constexpr double kSun_m = 1.745;  // half its width: one degree from afar
constexpr double kSunOnFloor = 1.02;
constexpr double kSunBounce = 0.12;

Lamp fixture(const Vector3d& position_m, double share) {
  Lamp lamp;
  lamp.group = position_m.x() < 0.0 ? "fluorescent_west" : "fluorescent_east";
  lamp.position_m = position_m;
  lamp.half_u_m = {0.6, 0.0, 0.0};  // u x v points down
  lamp.half_v_m = {0.0, -0.15, 0.0};
  lamp.strength = kFixture_m * share;
  lamp.bounce = kFixtureBounce * share;
  return lamp;
}

// Beyond the end at high x, a little to one side, squarely facing the sandbox.
Lamp sun(RandomStream& random) {
  const double elevation = radians(35.0);
  const double aside = radians(random.uniform(-8.0, 8.0));
  const Vector3d towards(cosine(elevation) * cosine(aside), cosine(elevation) * sine(aside),
                         sine(elevation));
  const Vector3d level = towards.cross(Vector3d::UnitZ()).normalized();
  Lamp lamp;
  lamp.group = "sun";
  lamp.position_m = kSunDistance_m * towards;
  lamp.half_u_m = kSun_m * level;
  lamp.half_v_m = kSun_m * level.cross(towards);
  lamp.strength = kSunOnFloor * kSunDistance_m * kSunDistance_m / towards.z();
  lamp.bounce = kSunBounce;
  return lamp;
}

Lamp window(double length_m, double width_m) {
  Lamp lamp;
  lamp.group = "window";
  lamp.position_m = {-0.2 * length_m, 0.5 * width_m + 1.43, 3.4};
  lamp.half_u_m = {1.6, 0.0, 0.0};  // u x v points into the hall
  lamp.half_v_m = {0.0, 0.0, 0.8};
  lamp.strength = 2.2;
  lamp.bounce = 0.01;
  return lamp;
}

}  // namespace

std::vector<Lamp> hall_lamps(double length_m, double width_m, double height_m, std::uint64_t seed) {
  RandomStream random(seed, 0x11647);
  std::vector<Lamp> lamps;
  for (const double side : {-1.0, 1.0}) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = length_m * (0.215 * column - 0.43) + 0.3 * side;
      const double share = random.uniform(0.85, 1.1);
      lamps.push_back(fixture({x, 0.36 * width_m * side, height_m - 0.2}, share));
    }
  }
  lamps.push_back(sun(random));
  lamps.push_back(window(length_m, width_m));
  return lamps;
}

double white_radiance(std::span<const Lamp> lamps, std::string_view group, const Vector3d& p,
                      const Vector3d& normal) {
  constexpr int kAcross = 4;  // samples of a lamp
  double radiance = 0.0;
  for (const Lamp& lamp : lamps) {
    if (!lamp.group.starts_with(group)) continue;
    const Vector3d facing = lamp.half_u_m.cross(lamp.half_v_m).normalized();
    radiance += lamp.bounce;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const int column = i % kAcross;
      const int row = i / kAcross;
      const double u = (2 * column + 1.0) / kAcross - 1.0;
      const double v = (2 * row + 1.0) / kAcross - 1.0;
      const Vector3d to = lamp.position_m + u * lamp.half_u_m + v * lamp.half_v_m - p;
      const double received = std::max(normal.dot(to), 0.0) * std::max(-facing.dot(to), 0.0);
      radiance +=
          lamp.strength * received / (to.squaredNorm() * to.squaredNorm()) / (kAcross * kAcross);
    }
  }
  return radiance;
}

}  // namespace dottrack::host_sim
