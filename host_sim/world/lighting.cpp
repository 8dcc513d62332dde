#include "host_sim/world/lighting.h"

#include <algorithm>

namespace dottrack::host_sim {
namespace {

double from_lamp(const Lamp& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d to_lamp = lamp.position_m - p;
  const double distance2 = to_lamp.squaredNorm();
  const double cosine = normal.dot(to_lamp) / std::sqrt(distance2);
  return lamp.strength * std::max(cosine, 0.0) / distance2;
}

double glint(const Lamp& lamp, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& to_eye) {
  const Eigen::Vector3d to_lamp = lamp.position_m - p;
  const Eigen::Vector3d halfway = (to_lamp.normalized() + to_eye).normalized();
  double power = std::max(normal.dot(halfway), 0.0);
  for (int doubling = 0; doubling < 6; ++doubling) power *= power;  // to the 64th
  return lamp.strength * power / to_lamp.squaredNorm();
}

}  // namespace

Illumination illuminate(const Lighting& lighting, const Eigen::Vector3d& p_world,
                        const Eigen::Vector3d& normal) {
  Illumination light;
  light.key = from_lamp(lighting.key, p_world, normal);
  light.rest = lighting.ambient * (0.6 + 0.4 * normal.z());
  for (const Lamp& lamp : lighting.fill) light.rest += from_lamp(lamp, p_world, normal);
  return light;
}

double reflection(const Lighting& lighting, const Eigen::Vector3d& p_world,
                  const Eigen::Vector3d& normal, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d to_eye = (eye - p_world).normalized();
  double sum = glint(lighting.key, p_world, normal, to_eye);
  for (const Lamp& lamp : lighting.fill) sum += glint(lamp, p_world, normal, to_eye);
  return sum;
}

}  // namespace dottrack::host_sim
