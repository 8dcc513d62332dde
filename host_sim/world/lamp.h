#pragma once
// What gives light, and how much of it when.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace dottrack::host_sim {

// A parallelogram that shines evenly from the side of half_u x half_v, as a Lambertian emitter.
// Radiance here and everywhere: 1 is a white surface that fills the grey scale at the reference
// exposure (SensorModel).
struct Lamp {
  std::string group;  // what is switched together: "fluorescent_west", "sun", "window", ...
  Eigen::Vector3d position_m;
  Eigen::Vector3d half_u_m;
  Eigen::Vector3d half_v_m;
  double strength = 0.0;  // radiance of a white surface squarely facing it from 1 m, at level 1
  double bounce = 0.0;    // radiance that walls and sand scatter of it onto every white surface
};

struct LightChange {
  std::string group;  // prefix: "fluorescent" is all of them
  double at_s = 0.0;
  double to = 1.0;      // level; 0 is off
  double over_s = 0.0;  // 0: switched; else faded linearly
};

// Levels of the groups over time.
struct LightPlan {
  std::vector<LightChange>
      changes;  // in order of time; those at or before 0 are the initial levels

  // 1 for a group that no change names.
  double level(std::string_view group, double time_s) const;
};

}  // namespace dottrack::host_sim
