#pragma once
// The pieces of make_hall(). Each adds to the model; the floor remembers what place is taken.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host_sim/world/hall.h"
#include "host_sim/world/lamp.h"
#include "host_sim/world/model.h"
#include "host_sim/world/pose.h"
#include "host_sim/world/random.h"
#include "host_sim/world/terrain.h"

namespace dottrack::host_sim {

inline constexpr double kAisle_m = 1.5;   // between the boards and the walls
inline constexpr double kBay_m = 10.0;    // between the boards and the wall at high x
inline constexpr double kBoard_m = 0.06;  // thickness
inline constexpr double kBoardTop_m = 0.24;
inline constexpr double kVehicleReach_m = 1.05;  // half the vehicle's diagonal

struct HallSite {
  const HallOptions& options;
  const Terrain& terrain;
  std::span<const Lamp> lamps;

  double half_length_m() const { return 0.5 * options.length_m; }
  double half_width_m() const { return 0.5 * options.width_m; }
  double west_m() const { return -half_length_m() - kAisle_m; }  // the walls' inner faces
  double east_m() const { return half_length_m() + kBay_m; }
  double north_m() const { return half_width_m() + kAisle_m; }
};

// What place on the ground is taken.
class GroundPlan {
 public:
  explicit GroundPlan(const HallSite& site) : site_(site) {}

  void take(const Eigen::Vector2d& middle, double radius_m) {
    taken_.push_back({middle, radius_m});
  }
  bool is_free(const Eigen::Vector2d& middle, double radius_m) const;
  // A free place on the sand, taken now; the vehicle comes no nearer than `clear_m` to it.
  std::optional<Eigen::Vector2d> find_on_sand(RandomStream& random, double radius_m,
                                              double clear_m);

 private:
  struct Circle {
    Eigen::Vector2d middle;
    double radius_m;
  };

  bool is_on_ramp(const Eigen::Vector2d& middle, double radius_m) const;

  const HallSite& site_;
  std::vector<Circle> taken_;
};

// As the ground lies there, turned about its normal.
Pose lying_on(const Terrain& terrain, const Eigen::Vector2d& place, double yaw_rad);

void add_calibration_dots(Model& hall, const HallSite& site, GroundPlan& plan);
void add_building(Model& hall, const HallSite& site);
void add_lights(Model& hall, const HallSite& site);
void add_furniture(Model& hall, const HallSite& site, GroundPlan& plan);
void add_sandbox(Model& hall, const HallSite& site);
void add_rocks_and_look_alikes(Model& hall, const HallSite& site, GroundPlan& plan);

// Petals with four clusters of bright bags, within 1.35 m of the origin, standing on z = 0.
Model make_lander(std::uint64_t seed);

}  // namespace dottrack::host_sim
