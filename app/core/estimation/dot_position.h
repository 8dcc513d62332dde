#pragma once
// One dot's 3-D position from all the cameras that see it (paper sections 3.1.4, 3.2.3, appendix).

#include <Eigen/Core>
#include <cstdint>

#include "app/core/estimation/sighting.h"
#include "app/core/rig.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::estimation {

// One camera's view of a dot. Both pointers outlive the call they are passed to.
struct View {
  std::size_t camera = 0;  // index in the rig
  const core::Camera* model = nullptr;
  const Sighting* sighting = nullptr;
  // How far the dot has come, when this camera exposes, from where it is at the instant in
  // question.
  Eigen::Vector3d moved_m = Eigen::Vector3d::Zero();

  Eigen::Vector2d pixel_of(const Eigen::Vector3d& point_m) const {
    return sighting->pixel_of(point_m + moved_m);
  }
};

using Views = StaticVector<View, kMaxCameras>;

struct DotPosition {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  double diameter_m = 0.0;         // mean over the views of the semi-major axis's full length
  double worst_residual_px = 0.0;  // of the views that agree
  CameraSet cameras;               // whose views agree
};

// Weighted least squares over all views; while the result does not project into the bounding box of
// every view, or one of four or more views stands far out from the agreement of the others, the
// view it misses most is dropped and the rest solved again. False when fewer than two views agree;
// `position` is then as it was.
bool locate_dot(Views views, DotPosition& position);

}  // namespace dottrack::estimation
