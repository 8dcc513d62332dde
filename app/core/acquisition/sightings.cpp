#include "app/core/acquisition/sightings.h"

#include <algorithm>
#include <array>
#include <span>

#include "app/core/geometry/pixel_bundle.h"

namespace dottrack::acquisition {
namespace {

estimation::DiameterRange diameters(const core::Target& target) {
  return {core::smallest_dot_diameter_m(target), core::largest_dot_diameter_m(target)};
}

// Of a bundle of sightings, by their model or, where it does not know, one by one; false for those
// without any.
std::array<bool, geometry::PixelBundle::kCapacity> add_lines(
    const core::Camera& camera, geometry::PixelBundle& bundle,
    std::span<estimation::Sighting> sightings) {
  bundle.size = sightings.size();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    bundle.x[i] = sightings[i].pixel.x();
    bundle.y[i] = sightings[i].pixel.y();
  }
  geometry::unproject_bundle(camera.model, bundle);
  std::array<bool, geometry::PixelBundle::kCapacity> seen{};
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (bundle.known[i] != 0) {
      sightings[i].line.ray = bundle.ray(i, camera.model);
      sightings[i].pixels_per_rad = bundle.pixels_per_rad(i);
      seen[i] = true;
    } else {
      seen[i] = estimation::add_line_of_sight(camera, sightings[i]);
    }
  }
  return seen;
}

// Those without one are taken out.
void add_lines_of_sight(const core::Camera& camera, estimation::Sightings& sightings) {
  geometry::PixelBundle bundle;
  std::size_t kept = 0;
  for (std::size_t from = 0; from < sightings.size(); from += geometry::PixelBundle::kCapacity) {
    const std::size_t size = std::min(geometry::PixelBundle::kCapacity, sightings.size() - from);
    const auto seen = add_lines(camera, bundle, {sightings.data() + from, size});
    for (std::size_t i = 0; i < size; ++i) {
      if (!seen[i]) continue;
      if (kept != from + i) sightings[kept] = sightings[from + i];
      ++kept;
    }
  }
  sightings.resize(kept);
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
  estimation::Sightings& sightings = view.sightings;
  if (regions == nullptr) return sightings.clear();
  const estimation::DiameterRange dots = diameters(target);
  // In place of those before: all that counts of one is written, so there is nothing to clear.
  sightings.resize(regions->size());
  std::size_t described = 0;
  for (std::size_t r = 0; r < regions->size(); ++r) {
    const image::Region& region = (*regions)[r];
    if (region.touches_border) continue;
    estimation::Sighting& sighting = sightings[described];
    if (!estimation::describe_sighting(*view.camera, optics, dots, region, sighting)) continue;
    sighting.region = static_cast<std::uint16_t>(r);
    ++described;
  }
  sightings.resize(described);
  add_lines_of_sight(*view.camera, sightings);
}

}  // namespace dottrack::acquisition
