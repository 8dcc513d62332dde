#pragma once
// One model before a ray. Embree finds which solid is met; where exactly is then worked out in
// double precision from the solid itself, so that neither Embree's single precision nor a
// processor's approximate reciprocals show in a picture. Marks are not met: they are painted on.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "host_sim/world/model.h"
#include "host_sim/world/pose.h"

namespace dottrack::host_sim {

struct RayHit {
  double distance = 0.0;                             // in units of the ray's direction
  int part = -1;                                     // of the model; -1: nothing was met
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
  // A box around everything.
  const Eigen::Vector3d& low() const { return low_; }
  const Eigen::Vector3d& high() const { return high_; }

  // What the ray meets first, nearer than `farthest` (in units of `direction`).
  RayHit meet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
              double farthest) const;
  // Whether anything stands between the two points. What shines by itself throws no shadow: a tube
  // does not hide its own lamp.
  bool blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  // The same for four points at once, in half the time: bit i is set where to[i] is hidden.
  unsigned blocked(const Eigen::Vector3d& from, const std::array<Eigen::Vector3d, 4>& to) const;

 private:
  struct Device;  // Embree's handles

  Model model_;
  std::unique_ptr<Device> device_;
  std::vector<std::vector<Eigen::Vector3f>> vertex_normals_;  // of smooth meshes, by part
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double radius_m_ = 0.0;
};

}  // namespace dottrack::host_sim
