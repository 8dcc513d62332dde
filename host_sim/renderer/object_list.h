#pragma once
// Objects as seen from one fixed point, with what a quick refusal needs worked out beforehand.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host_sim/world/object.h"

namespace dottrack::host_sim {

class ObjectList {
 public:
  // The objects stay where they are for as long as the list is used.
  ObjectList(std::span<const Object> objects, const Eigen::Vector3d& eye);

  // Looks whether the line from the eye meets object i nearer than `hit`; if so, updates hit.
  bool nearer(std::size_t i, const Line& line, Hit& hit) const {
    const Target& t = targets_[i];
    const double along = t.to_centre.dot(line.direction);
    const double length2 = line.direction.squaredNorm();
    if (along * along < length2 * t.tangent2_m2) return false;  // passes the ball by
    Hit candidate;
    if (!intersect(objects_[i].shape, line, candidate)) return false;
    if (!(candidate.distance < hit.distance)) return false;
    hit = candidate;
    return true;
  }

  std::size_t size() const { return objects_.size(); }
  const Object& operator[](std::size_t i) const { return objects_[i]; }

 private:
  struct Target {
    Eigen::Vector3d to_centre;  // from the eye to the bounding ball
    double tangent2_m2;         // squared length of the tangent to the ball; negative inside it
  };

  std::span<const Object> objects_;
  std::vector<Target> targets_;
};

}  // namespace dottrack::host_sim
