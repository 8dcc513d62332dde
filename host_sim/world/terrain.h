#pragma once
// The ground: uneven sand inside the boards, a flat floor outside, and perhaps a ramp in the sand.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "host_sim/world/portable_math.h"

namespace dottrack::host_sim {

// A plank that rises from its foot; its first decimetres are rounded into the ground.
struct Ramp {
  Eigen::Vector2d foot_m = Eigen::Vector2d::Zero();  // middle of the lower edge
  double heading_rad = 0.0;                          // that one drives up in, from world x
  double angle_rad = radians(25.0);
  double length_m = 4.0;  // along the slope
  double width_m = 2.0;
};

// World coordinates; the sandbox's middle is the origin, its length along x. Immutable, cheap to
// copy. Heights are smooth (continuous slope) but for the ramp's sides and upper end.
class Terrain {
 public:
  Terrain(double length_m, double width_m, std::uint64_t seed, std::optional<Ramp> ramp = {});

  // Of what one drives on: the ramp where there is one, the sand elsewhere, 0 outside.
  double height_m(const Eigen::Vector2d& p) const;
  Eigen::Vector3d normal(const Eigen::Vector2d& p) const;  // unit, of the same

  double sand_height_m(const Eigen::Vector2d& p) const;
  // Above the sand at a point of the ramp's middle line this far (seen from above) from its foot.
  double ramp_height_m(double along_m) const;

  bool is_sand(const Eigen::Vector2d& p) const;
  double length_m() const { return 2.0 * half_length_m_; }
  double width_m() const { return 2.0 * half_width_m_; }
  const std::optional<Ramp>& ramp() const { return ramp_; }
  // Along the ramp's heading and to its left, from the foot. Only with a ramp.
  Eigen::Vector2d in_ramp(const Eigen::Vector2d& p) const;

 private:
  double flattening(const Eigen::Vector2d& p) const;

  double half_length_m_;
  double half_width_m_;
  std::uint64_t seed_;
  std::optional<Ramp> ramp_;
  Eigen::Vector2d ramp_forward_ = Eigen::Vector2d::UnitX();
};

}  // namespace dottrack::host_sim
