#pragma once
// The lamps of the hall.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "host_sim/world/lamp.h"

namespace dottrack::host_sim {

// Two rows of five fixtures ("fluorescent_west" at x < 0, "fluorescent_east"), "window", and
// "sun", far away beyond the end at high x, one degree wide. What burns is the light plan's
// business: with none, all do. A white floor has a radiance of 0.45 to 0.75 under the fluorescent
// lamps; the sun adds 1.0 to 1.3.
std::vector<Lamp> hall_lamps(double length_m, double width_m, double height_m, std::uint64_t seed);

// Radiance of a white surface at `p` with this normal, nothing in the way, all lamps whose group
// begins with `group` at level 1.
double white_radiance(std::span<const Lamp> lamps, std::string_view group, const Eigen::Vector3d& p,
                      const Eigen::Vector3d& normal);

}  // namespace dottrack::host_sim
