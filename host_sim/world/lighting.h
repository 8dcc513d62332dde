#pragma once
// The light: one key lamp that throws shadows, fill lamps that do not, and the room's own glow.

#include <Eigen/Core>
#include <vector>

namespace dottrack::host_sim {

struct Lamp {
  Eigen::Vector3d position_m;
  double strength = 0.0;  // what a white surface facing it from 1 m gives back, 1 = full scale
};

struct Lighting {
  Lamp key;
  double key_radius_m = 0.4;  // of its disc: how soft its shadows are
  std::vector<Lamp> fill;
  double ambient = 0.2;
};

// Light that a point of a surface receives, as what a white one gives back.
struct Illumination {
  double key = 0.0;   // to be taken away in the key lamp's shadow
  double rest = 0.0;  // fill and ambient
};

// normal: unit, world.
Illumination illuminate(const Lighting& lighting, const Eigen::Vector3d& p_world,
                        const Eigen::Vector3d& normal);

// Mirror-like reflection of the lamps seen from `eye`, same units; multiply by the gloss.
double reflection(const Lighting& lighting, const Eigen::Vector3d& p_world,
                  const Eigen::Vector3d& normal, const Eigen::Vector3d& eye);

}  // namespace dottrack::host_sim
