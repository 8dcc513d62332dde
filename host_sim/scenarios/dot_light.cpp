#include "host_sim/scenarios/dot_light.h"

#include <algorithm>
#include <limits>

#include "host_sim/renderer/lamp_light.h"
#include "host_sim/scenarios/dot_disc.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

constexpr double kEven = 0.75;       // the darkest of an evenly lit dot, of its brightest
constexpr double kAboveLeast = 1.5;  // of the least grey level
constexpr double kDotAlbedo = 0.9;

// Radiance of a white surface at `p`.
double light_at(const Vector3d& p, const Vector3d& normal, std::span<const LampLight> lamps,
                std::span<const double> levels, const Obstacles& obstacles) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    sum += levels[i] * lamps[i].bounce;
    const double direct = levels[i] * from_lamp(lamps[i], p, normal);
    if (!(direct > 0.0)) continue;
    const double share = share_in_sight(lamps[i], true, [&](const auto& points) {
      unsigned hidden = 0;
      for (unsigned k = 0; k < points.size(); ++k) {
        if (obstacles.hidden(points[k], p)) hidden |= 1U << k;
      }
      return hidden;
    });
    sum += direct * share;
  }
  return sum;
}

}  // namespace

std::vector<DotLight> light_on_dots(const TargetLayout& target, const Pose& vehicle,
                                    const Hall& hall, std::span<const MovingBody> bodies,
                                    const LightPlan& light, double time_s) {
  std::vector<LampLight> lamps;
  std::vector<double> levels;
  for (const Lamp& lamp : hall.lamps) {
    lamps.emplace_back(lamp);
    levels.push_back(light.level(lamp.group, time_s));
  }
  const Obstacles obstacles(hall, bodies, time_s);
  std::vector<DotLight> lit;
  for (const TargetDot& dot : target) {
    const Disc disc = disc_of(dot, vehicle);
    const double middle = light_at(disc.middle, disc.normal, lamps, levels, obstacles);
    DotLight& of_dot = lit.emplace_back(DotLight{middle, middle});
    for (const Vector3d& p : disc.rim) {
      const double at = light_at(p, disc.normal, lamps, levels, obstacles);
      of_dot.darkest = std::min(of_dot.darkest, at);
      of_dot.brightest = std::max(of_dot.brightest, at);
    }
  }
  return lit;
}

bool well_lit(const DotLight& dot, const Scene& scene, double opening) {
  double dimmest = std::numeric_limits<double>::infinity();
  for (const SceneCamera& camera : scene.cameras) {
    dimmest = std::min(dimmest, camera.sensor.sensitivity * camera.gain * camera.exposure_s /
                                    kReferenceExposure_s);
  }
  const double grey_dn = 255.0 * dimmest * opening * kDotAlbedo * dot.darkest;
  return dot.darkest >= kEven * dot.brightest &&
         grey_dn >= kAboveLeast * scene.appearance.intensity_min_dn;
}

}  // namespace dottrack::host_sim
