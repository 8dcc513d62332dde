#pragma once
// One model before a ray: Embree holds the solids, marks are met exactly.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "host_sim/world/model.h"
#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

struct RayHit {
  double distance = 0.0;  // in units of the ray's direction
  int part = -1;          // of the model; -1: nothing was met
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, towards the ray's origin; smooth where
                                                     // the mesh is
};

// In the model's own coordinates. Immutable after construction: any number of threads may ask.
class RayScene {
 public:
  explicit RayScene(Model model);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  const Model& model() const { return model_; }
  // A ball around everything; radius 0 for an empty model.
  const Eigen::Vector3d& middle() const { return middle_; }
  double radius_m() const { return radius_m_; }

  // What the ray meets first, nearer than `farthest` (in units of `direction`).
  RayHit meet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
              double farthest) const;
  // Whether anything stands between the two points.
  bool blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  struct Device;  // Embree's handles

  Model model_;
  std::unique_ptr<Device> device_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double radius_m_ = 0.0;
};

}  // namespace dottrack::host_sim
