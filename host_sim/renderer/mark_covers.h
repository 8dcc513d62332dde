#pragma once
// Which share of which pixel each mark covers: exact, whatever hides it aside. Along 16 lines in
// each pixel the stretch inside the mark is solved for, so that the centroid of a mark's picture is
// that of its projected outline.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host_sim/renderer/actor.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/ray_lattice.h"
#include "host_sim/renderer/sim_camera.h"

namespace dottrack::host_sim {

struct MarkCover {
  int pixel = 0;
  int thing = kNothing;  // that carries it
  int mark = 0;
  double share = 0.0;  // of the pixel
};

class MarkCovers {
 public:
  // All of them outlive this.
  MarkCovers(std::span<const Actor> actors, const SimCamera& camera, const RayLattice& rays);

  // Those that touch a pixel.
  std::span<const MarkCover> at(int x, int y) const;

 private:
  void add(const Actor& actor, int number);
  PixelBox box_of(const Actor& actor, const Mark& mark, int row) const;
  double share(const Pose& pose, const Mark& mark, int x, int y) const;

  const SimCamera& camera_;
  const RayLattice& rays_;
  std::vector<MarkCover> covers_;  // by pixel
};

inline bool on_mark(const Mark& mark, const Eigen::Vector3d& p_body) {
  return (p_body - mark.centre_m).squaredNorm() < mark.radius_m * mark.radius_m;
}

}  // namespace dottrack::host_sim
