#include "host_sim/renderer/object_list.h"

#include <algorithm>

namespace dottrack::host_sim {
namespace {

std::vector<Ball> bounds_of(std::span<const Object> objects) {
  std::vector<Ball> balls;
  for (const Object& object : objects) balls.push_back(object.bound);
  return balls;
}

}  // namespace

ObjectList::ObjectList(std::span<const Object> objects, const Eigen::Vector3d& eye,
                       const PixelBox& box, const std::function<Eigen::Vector3d(int, int)>& corner)
    : objects_(objects), eye_(eye), tiles_(bounds_of(objects), eye, box, corner) {
  for (const Object& object : objects) {
    const Eigen::Vector3d to_centre = object.bound.centre - eye;
    const double radius_m = object.bound.radius_m * (1.0 + 1e-9);
    targets_.push_back({to_centre, to_centre.squaredNorm() - radius_m * radius_m});
  }
}

int ObjectList::nearest(int x, int y, const Eigen::Vector3d& direction, Hit& hit) const {
  const Line line{eye_, direction};
  int found = -1;
  for (const std::uint16_t i : tiles_.at(x, y)) {
    if (passes_by(targets_[i], direction)) continue;
    Hit candidate;
    if (!intersect(objects_[i].shape, line, candidate)) continue;
    if (!(candidate.distance < hit.distance)) continue;
    hit = candidate;
    found = i;
  }
  return found;
}

bool ObjectList::obstructed(int x, int y, const Eigen::Vector3d& direction, double distance) const {
  const Line line{eye_, direction};
  const auto tile = tiles_.at(x, y);
  return std::any_of(tile.begin(), tile.end(), [&](std::uint16_t i) {
    Hit hit;
    return objects_[i].obstructs && !passes_by(targets_[i], direction) &&
           intersect(objects_[i].shape, line, hit) && hit.distance < distance;
  });
}

}  // namespace dottrack::host_sim
