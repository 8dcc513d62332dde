#include "host_sim/renderer/object_list.h"

namespace dottrack::host_sim {

ObjectList::ObjectList(std::span<const Object> objects, const Eigen::Vector3d& eye)
    : objects_(objects) {
  targets_.reserve(objects.size());
  for (const Object& object : objects) {
    const Eigen::Vector3d to_centre = object.bound.centre - eye;
    const double radius_m = object.bound.radius_m * (1.0 + 1e-9);
    targets_.push_back({to_centre, to_centre.squaredNorm() - radius_m * radius_m});
  }
}

}  // namespace dottrack::host_sim
