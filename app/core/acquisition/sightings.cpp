#include "app/core/acquisition/sightings.h"

#include <array>
#include <cstdint>

#include "app/core/estimation/sighting_bundle.h"
#include "app/core/geometry/pixel_bundle.h"

namespace dottrack::acquisition {
namespace {

estimation::DiameterRange diameters(const core::Target& target) {
  return {core::smallest_dot_diameter_m(target), core::largest_dot_diameter_m(target)};
}

// A few of a camera's regions on their way to sightings, side by side.
struct Bundle {
  static constexpr std::size_t kCapacity = geometry::PixelBundle::kCapacity;
  static_assert(kCapacity == estimation::SightingBundle::kCapacity);

  std::size_t size = 0;
  std::array<std::uint16_t, kCapacity> region;
  estimation::SightingBundle sizes;
  geometry::PixelBundle pixels;
};

// From region `next` on, those that are whole and that the lens can show; returns where it stopped.
std::size_t gather(const image::Regions& regions, std::size_t next, const geometry::Optics& optics,
                   Bundle& bundle) {
  bundle.size = 0;
  for (; next < regions.size() && bundle.size < Bundle::kCapacity; ++next) {
    const image::Region& region = regions[next];
    const geometry::AngularScale& scale = optics.at(region.centroid_px);
    bundle.region[bundle.size] = static_cast<std::uint16_t>(next);
    bundle.sizes.semi_major_px[bundle.size] = region.semi_major_px;
    bundle.sizes.least_px_per_rad[bundle.size] = scale.min_px;
    bundle.sizes.most_px_per_rad[bundle.size] = scale.max_px;
    bundle.pixels.x[bundle.size] = region.centroid_px.x();
    bundle.pixels.y[bundle.size] = region.centroid_px.y();
    bundle.size += !region.touches_border && scale.max_px > 0.0;
  }
  bundle.sizes.size = bundle.pixels.size = bundle.size;
  return next;
}

// By the camera's model or, where the bundle does not know, by itself; false without a line.
bool add_line(const core::Camera& camera, const geometry::PixelBundle& pixels, std::size_t i,
              estimation::Sighting& sighting) {
  if (pixels.known[i] == 0) return estimation::add_line_of_sight(camera, sighting);
  sighting.line.ray = pixels.ray(i, camera.model);
  sighting.pixels_per_rad = pixels.pixels_per_rad(i);
  return true;
}

// Writes those of the bundle that have a distance and a line of sight; returns how many.
std::size_t write(const core::Camera& camera, const image::Regions& regions, const Bundle& bundle,
                  estimation::Sighting* to) {
  const estimation::Sighting* const first = to;
  for (std::size_t i = 0; i < bundle.size; ++i) {
    to->window = {bundle.sizes.near_m[i], bundle.sizes.far_m[i]};
    if (to->window.empty()) continue;
    to->take_shape(regions[bundle.region[i]]);
    to->region = bundle.region[i];
    to->line.sigma_rad = bundle.sizes.sigma_rad[i];
    to->angular_diameter_rad = bundle.sizes.angular_diameter_rad[i];
    to += add_line(camera, bundle.pixels, i, *to);
  }
  return static_cast<std::size_t>(to - first);
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
  const core::Camera& camera = *view.camera;
  // In place of those before: all that counts of one is written, so there is nothing to clear.
  sightings.resize(regions->size());
  std::size_t size = 0;
  Bundle bundle;
  for (std::size_t next = 0; next < regions->size();) {
    next = gather(*regions, next, optics, bundle);
    estimation::describe_sightings(diameters(target),
                                   {camera.distance_min_m, camera.distance_max_m}, bundle.sizes);
    geometry::unproject_bundle(camera.model, bundle.pixels);
    size += write(camera, *regions, bundle, sightings.data() + size);
  }
  sightings.resize(size);
}

}  // namespace dottrack::acquisition
