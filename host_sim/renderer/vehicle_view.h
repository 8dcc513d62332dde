#pragma once
// The vehicle in one pose, as one camera sees it, and its shadow on the ground.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/object_list.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/radiance.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/shadow.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/renderer/surface.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

class VehicleView {
 public:
  // All references must outlive this.
  VehicleView(const Vehicle& vehicle, const Pose& pose, const Lighting& lighting,
              const LampDisc& lamp, const SimCamera& camera, const RayLattice& rays);

  // Pixels that the vehicle or its shadow may touch; the whole image when that is not clear.
  const PixelBox& reach() const { return reach_; }

  // What of the vehicle the line through a pixel within reach meets; surface kNothing when it
  // passes by.
  SurfaceHit cast(int x, int y, const Eigen::Vector3d& direction) const;

  bool is_mark(int surface) const;

  // Of a patch of the vehicle, its own shadows included.
  Radiance radiance(const Patch& patch) const;

  // What the vehicle leaves of the light at a point of the ground: 1 where it takes nothing.
  struct Shade {
    double key = 1.0;
    double rest = 1.0;
  };
  Shade shade_on_ground(const Eigen::Vector3d& p_world) const;

 private:
  double key_share(const Eigen::Vector3d& p_world, const Eigen::Vector3d& normal_world) const;

  const Vehicle& vehicle_;
  Pose pose_;
  const Lighting& lighting_;
  const SimCamera& camera_;
  PixelBox reach_;
  LampDisc lamp_body_;
  ObjectList objects_;
  std::vector<std::uint16_t> shadow_casters_;
};

}  // namespace dottrack::host_sim
