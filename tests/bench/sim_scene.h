#pragma once
// One tick of the simulator's cluttered hall: what twelve cameras see of a rover among three times
// the stones and look-alikes.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "app/core/camera_frame.h"
#include "app/core/rig.h"
#include "host_sim/renderer/camera_view.h"

namespace dottrack::bench {

class SimScene {
 public:
  // The scenario `clutter`, with so many dots on the rover. Throws where it cannot be read.
  explicit SimScene(std::size_t dots);

  const core::Rig& rig() const { return rig_; }
  std::array<core::CameraFrame, kMaxCameras> frames() const;
  const Eigen::Vector3d& place_m() const { return place_m_; }

  // One scene a number of dots, made when it is first asked for.
  static const SimScene& of(std::size_t dots);

 private:
  core::Rig rig_;
  std::vector<host_sim::GreyImage> images_;
  Eigen::Vector3d place_m_;
};

}  // namespace dottrack::bench
