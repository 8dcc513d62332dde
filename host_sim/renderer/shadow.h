#pragma once
// The key lamp's shadows: how much of its disc a point sees.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host_sim/world/lighting.h"
#include "host_sim/world/object.h"
#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

// The key lamp as a disc that faces the world's origin, with points spread evenly over it.
struct LampDisc {
  Eigen::Vector3d middle;
  double radius_m;
  std::array<Eigen::Vector3d, 16> points;
};

LampDisc key_lamp_disc(const Lighting& lighting);

// The same lamp in a body's coordinates.
LampDisc to_body(const LampDisc& lamp, const Pose& body);

// Which share of the lamp a point sees past some of `objects`: 0 (all dark) to 1 (all light).
double visible_share(const LampDisc& lamp, const Eigen::Vector3d& from,
                     std::span<const Object> objects, std::span<const std::uint16_t> which);

// Shadows of what stands still. Objects are sorted into the columns of a grid over the floor.
class StillShadows {
 public:
  // `objects` must outlive this.
  StillShadows(std::span<const Object> objects, const Lighting& lighting);

  double visible_share(const Eigen::Vector3d& p_world, const Eigen::Vector3d& normal) const;

 private:
  using Column = std::vector<std::uint16_t>;  // objects that may throw a shadow into it

  const Column& column_at(const Eigen::Vector3d& p_world) const;

  std::span<const Object> objects_;
  LampDisc lamp_;
  std::vector<Column> columns_;
};

}  // namespace dottrack::host_sim
