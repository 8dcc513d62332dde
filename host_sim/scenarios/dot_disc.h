#pragma once
// A dot as a disc in the world, and what may hide it.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/renderer/ray_scene.h"
#include "host_sim/world/pose.h"
#include "host_sim/world/target_layout.h"

namespace dottrack::host_sim {

inline constexpr int kRimPoints = 8;  // on a dot's edge

struct Disc {
  Eigen::Vector3d middle;
  Eigen::Vector3d normal;
  std::array<Eigen::Vector3d, kRimPoints> rim;
};

// `vehicle`: T_world_vehicle. A little off the face that the dot is painted on.
Disc disc_of(const TargetDot& dot, const Pose& vehicle);

// What stands between two points: the hall and the bodies where they are at one time.
class Obstacles {
 public:
  Obstacles(const Hall& hall, std::span<const MovingBody> bodies, double time_s);

  bool hidden(const Eigen::Vector3d& eye, const Eigen::Vector3d& p) const;

 private:
  struct Placed {
    const RayScene* scene;
    Pose pose;
  };

  const Hall& hall_;
  std::vector<Placed> placed_;
};

}  // namespace dottrack::host_sim
