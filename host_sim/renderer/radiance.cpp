#include "host_sim/renderer/radiance.h"

namespace dottrack::host_sim {

Radiance radiance_of(const Material& material, const SurfacePoint& point, const Lighting& lighting,
                     const Eigen::Vector3d& eye) {
  const double albedo = albedo_at(material, point.p_body, point.footprint_m);
  const Illumination light = illuminate(lighting, point.p_world, point.normal);
  Radiance radiance{albedo * light.key, albedo * light.rest};
  if (material.gloss > 0.0) {
    radiance.rest += material.gloss * reflection(lighting, point.p_world, point.normal, eye);
  }
  return radiance;
}

}  // namespace dottrack::host_sim
