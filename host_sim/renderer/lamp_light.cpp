#include "host_sim/renderer/lamp_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dottrack::host_sim {
namespace {

constexpr double kOffLamp_m = 0.02;  // lines of sight end before the lamp's own housing

// The n-th of 16 points of a Hammersley net, in the order that spreads any first four: [-1, 1]^2.
Eigen::Vector2d spread(unsigned n) {
  unsigned bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits |= ((n >> i) & 1U) << (3U - i);
  // Sobol's second dimension: Pascal's triangle modulo 2 over the bits of n.
  constexpr std::array<unsigned, 4> kDirections{8U, 12U, 10U, 15U};
  unsigned second = 0;
  for (unsigned i = 0; i < 4; ++i) {
    if (((n >> i) & 1U) != 0U) second ^= kDirections[i];
  }
  return Eigen::Vector2d(bits, second) / 8.0 - Eigen::Vector2d::Constant(15.0 / 16.0);
}

}  // namespace

LampLight::LampLight(const Lamp& lamp)
    : normal(lamp.half_u_m.cross(lamp.half_v_m).normalized()),
      reach{lamp.position_m, (lamp.half_u_m.cwiseAbs() + lamp.half_v_m.cwiseAbs()).norm()},
      strength(lamp.strength),
      bounce(lamp.bounce) {
  for (unsigned n = 0; n < 16; ++n) {
    const Eigen::Vector2d at = spread(n);
    points[n / 4][n % 4] =
        lamp.position_m + at.x() * lamp.half_u_m + at.y() * lamp.half_v_m + kOffLamp_m * normal;
  }
}

double from_lamp(const LampLight& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d to_lamp = lamp.reach.middle - p;
  const double cosines = normal.dot(to_lamp) * -lamp.normal.dot(to_lamp);
  if (!(normal.dot(to_lamp) > 0.0 && cosines > 0.0)) return 0.0;
  const double distance2 = to_lamp.squaredNorm();
  return lamp.strength * cosines / (distance2 * distance2);
}

double glint(const LampLight& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& to_eye) {
  const Eigen::Vector3d to_lamp = lamp.reach.middle - p;
  const double distance2 = to_lamp.squaredNorm();
  const double away = -lamp.normal.dot(to_lamp) / std::sqrt(distance2);
  if (!(away > 0.0 && normal.dot(to_lamp) > 0.0)) return 0.0;
  const Eigen::Vector3d halfway = (to_lamp / std::sqrt(distance2) + to_eye).normalized();
  double power = std::max(normal.dot(halfway), 0.0);
  for (int doubling = 0; doubling < 6; ++doubling) power *= power;  // to the 64th
  return lamp.strength * away * power / distance2;
}

}  // namespace dottrack::host_sim
