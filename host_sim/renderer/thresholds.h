#pragma once
// What of the light is too little to work out. Radiance: 1 is 255 grey levels.

#include <algorithm>
#include <numeric>
#include <vector>

namespace dottrack::host_sim {

// Shadows between nodes that agree within this are interpolated.
inline constexpr double kEvenRadiance = 1.5 / 255.0;

// Below this a lamp throws no shadow on a patch: a hundredth of all its light, or what would not
// be seen.
inline double faint_radiance(const std::vector<double>& by_lamp) {
  constexpr double kInvisible = 0.15 / 255.0;
  return std::max(kInvisible, 0.01 * std::accumulate(by_lamp.begin(), by_lamp.end(), 0.0));
}

}  // namespace dottrack::host_sim
