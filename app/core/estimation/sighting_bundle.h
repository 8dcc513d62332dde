#pragma once
// Many regions of one camera at a time: what describe_sighting makes of their sizes.

#include <array>
#include <cstddef>

#include "app/core/estimation/dot_size.h"

namespace dottrack::estimation {

// Side by side, as many as are given of each; beyond size anything.
struct SightingBundle {
  static constexpr std::size_t kCapacity = 64;
  using Numbers = std::array<double, kCapacity>;

  std::size_t size = 0;
  alignas(64) Numbers semi_major_px;
  alignas(64) Numbers least_px_per_rad;  // geometry::AngularScale's, where the region is
  alignas(64) Numbers most_px_per_rad;

  alignas(64) Numbers near_m;  // as possible_range has them; near > far where it may be nowhere
  alignas(64) Numbers far_m;
  alignas(64) Numbers sigma_rad;             // see SightLine
  alignas(64) Numbers angular_diameter_rad;  // of the semi-major axis, both halves
};

// The same bits as of one region at a time, on every processor.
void describe_sightings(const DiameterRange& diameter, const RangeWindow& limits,
                        SightingBundle& bundle) noexcept;

}  // namespace dottrack::estimation
