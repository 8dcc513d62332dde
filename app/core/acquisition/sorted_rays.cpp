#include "app/core/acquisition/sorted_rays.h"

#include <algorithm>

namespace dottrack::acquisition {

void sort(const PencilRays& rays, std::size_t size, SortedRays& sorted) {
  constexpr std::size_t kBuckets = SortedRays::kBuckets;
  sorted.size = size - rays.stray.size();
  sorted.least_angle = rays.least_angle;
  sorted.greatest_angle = rays.greatest_angle;
  sorted.buckets_per_rad = kBuckets / std::max(rays.greatest_angle - rays.least_angle, 1e-6F);
  auto& start = sorted.start;
  start.fill(0);
  for (std::size_t i = 0; i < size; ++i) {
    if (rays.is_stray(i)) continue;
    sorted.bucket_of[i] = static_cast<std::uint16_t>(sorted.bucket(rays.angle[i]));
    ++start[sorted.bucket_of[i] + 1U];
  }
  for (std::size_t b = 0; b < kBuckets; ++b) {
    start[b + 1] = static_cast<std::uint16_t>(start[b + 1] + start[b]);
  }
  std::array<std::uint16_t, kBuckets> next;
  std::copy_n(start.begin(), kBuckets, next.begin());
  for (std::size_t i = 0; i < size; ++i) {
    if (rays.is_stray(i)) continue;
    const std::size_t to = next[sorted.bucket_of[i]]++;
    sorted.index[to] = static_cast<std::uint16_t>(i);
    sorted.angle[to] = rays.angle[i];
    sorted.cotangent[to] = rays.cotangent[i];
    sorted.half_width[to] = rays.half_width[i];
    sorted.low[to] = rays.low[i];
    sorted.high[to] = rays.high[i];
  }
}

}  // namespace dottrack::acquisition
