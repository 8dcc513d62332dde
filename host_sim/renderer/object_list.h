#pragma once
// Objects as one camera sees them: sorted by where in the picture they may show, with what a quick
// refusal of a line of sight needs worked out beforehand.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/tile_index.h"
#include "host_sim/world/object.h"

namespace dottrack::host_sim {

class ObjectList {
 public:
  // The objects stay where they are for as long as the list is used. For eye, box and corner see
  // TileIndex; all in the coordinates of the objects' body.
  ObjectList(std::span<const Object> objects, const Eigen::Vector3d& eye, const PixelBox& box,
             const std::function<Eigen::Vector3d(int, int)>& corner);

  // The object that the line of sight through pixel (x, y) meets first, if it does so nearer than
  // `hit`, which is then updated; -1 otherwise.
  int nearest(int x, int y, const Eigen::Vector3d& direction, Hit& hit) const;

  // Whether the line of sight meets an object that obstructs before `distance`.
  bool obstructed(int x, int y, const Eigen::Vector3d& direction, double distance) const;

  const Object& operator[](std::size_t i) const { return objects_[i]; }

 private:
  struct Target {
    Eigen::Vector3d to_centre;  // from the eye to the bounding ball
    double tangent2_m2;         // squared length of the tangent to the ball; negative inside it
  };

  bool passes_by(const Target& target, const Eigen::Vector3d& direction) const {
    const double along = target.to_centre.dot(direction);
    return along * along < direction.squaredNorm() * target.tangent2_m2;
  }

  std::span<const Object> objects_;
  Eigen::Vector3d eye_;
  std::vector<Target> targets_;
  TileIndex tiles_;
};

}  // namespace dottrack::host_sim
