#pragma once
// How much light a surface gives back, and where.

#include <Eigen/Core>
#include <cstdint>

namespace dottrack::host_sim {

enum class Pattern : std::uint8_t {
  plain,
  mottled,   // stone: patches of 2 to 20 cm
  cells,     // a solar panel: dark cells with thin brighter seams
  planks,    // boards along x or y, 14 cm
  stripes,   // warning tape, 12 cm
  sand,      // patches, grain and pebbles; its small relief is in the shading only
  concrete,  // stains and joints
};

struct Material {
  double albedo = 0.5;  // 0 to 1
  Pattern pattern = Pattern::plain;
  double gloss = 0.0;  // strength of the lamps' reflections
  std::uint64_t seed = 0;
  double emission = 0.0;  // radiance of its own at the full level of `lamp`: a window, a tube
  int lamp = -1;          // index into the world's lamps; -1: gives no light of its own
};

// p_body: the point in the coordinates of the object's body; footprint_m: a pixel's width there,
// over which thin lines are averaged.
double albedo_at(const Material& material, const Eigen::Vector3d& p_body, double footprint_m);

// The surface's normal with the pattern's small relief added; unit, body coordinates.
Eigen::Vector3d relief_normal(const Material& material, const Eigen::Vector3d& p_body,
                              const Eigen::Vector3d& normal);

}  // namespace dottrack::host_sim
