#pragma once
// One camera's rays in a pencil, in the order of their angle: those near an angle lie together.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/core/acquisition/pencil.h"

namespace dottrack::acquisition {

struct SortedRays {
  // Positions in the order.
  struct Window {
    std::size_t first = 0;
    std::size_t last = 0;  // one beyond
  };

  // All rays within half_width of the angle; some others come along, none is missed.
  Window window(float around, float half_width_rad) const {
    const float from = around - half_width_rad;
    const float to = around + half_width_rad;
    if (!(from <= to) || to < least_angle || from > greatest_angle) return {};
    return {start[bucket(from)], start[bucket(to) + 1]};
  }

  alignas(32) FloatArray angle{};
  alignas(32) FloatArray cotangent{};
  alignas(32) FloatArray half_width{};
  alignas(32) FloatArray low{};
  alignas(32) FloatArray high{};
  std::array<std::uint16_t, core::kMaxRegions> index{};  // among the camera's sightings
  std::size_t size = 0;

  static constexpr std::size_t kBuckets = 512;
  std::size_t bucket(float at) const {
    const float scaled = (at - least_angle) * buckets_per_rad;
    constexpr auto kLast = static_cast<float>(kBuckets - 1);  // std::clamp would branch
    return static_cast<std::size_t>(static_cast<int>(std::min(std::max(scaled, 0.0F), kLast)));
  }
  std::array<std::uint16_t, kBuckets + 1> start{};
  std::array<std::uint16_t, core::kMaxRegions> bucket_of{};
  float least_angle = 0.0F;
  float greatest_angle = 0.0F;
  float buckets_per_rad = 0.0F;
};

// All but the strays. Sorted coarsely, by buckets.
void sort(const PencilRays& rays, std::size_t size, SortedRays& sorted);

}  // namespace dottrack::acquisition
