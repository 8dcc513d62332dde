#include "app/core/acquisition/sightings.h"

#include <algorithm>

namespace dottrack::acquisition {
namespace {

estimation::DiameterRange diameters(const core::Target& target) {
  return {core::smallest_dot_diameter_m(target), core::largest_dot_diameter_m(target)};
}

}  // namespace

image::RegionGate acquisition_gate(const core::Camera& camera, const geometry::Optics& optics,
                                   const core::Target& target) {
  const estimation::DiameterRange dots = diameters(target);
  const geometry::AngularScale& scale = optics.extremes();
  return estimation::dot_gate(
      camera, {estimation::expected_semi_major(dots, camera.distance_max_m, scale).min_px,
               estimation::expected_semi_major(dots, camera.distance_min_m, scale).max_px});
}

void take_sightings(const core::Target& target, const geometry::Optics& optics,
                    const image::Regions* regions, CameraView& view) {
  view.sightings.clear();
  view.origin_offset_m = 0.0;
  if (regions == nullptr) return;
  const estimation::DiameterRange dots = diameters(target);
  const Eigen::Vector3d& centre = geometry::centre(view.camera->model);
  for (std::size_t r = 0; r < regions->size(); ++r) {
    const image::Region& region = (*regions)[r];
    estimation::Sighting sighting;
    if (region.touches_border ||
        !estimation::make_sighting(*view.camera, optics, dots, region, sighting)) {
      continue;
    }
    sighting.region = static_cast<std::uint16_t>(r);
    view.sightings.push_back(sighting);
    view.origin_offset_m =
        std::max(view.origin_offset_m, (sighting.line.ray.origin - centre).norm());
  }
}

}  // namespace dottrack::acquisition
