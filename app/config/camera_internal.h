#pragma once
// The internal model that C, A, H and V imply: what the files list as Hs, Hc, Vs, Vc, Theta.

#include <Eigen/Core>

#include "app/core/geometry/camera_model.h"

namespace dottrack::config {

struct InternalModel {
  double hs = 0.0;     // |A x H|, pixels
  double hc = 0.0;     // A . H, pixels: centre column
  double vs = 0.0;     // |A x V|, pixels
  double vc = 0.0;     // A . V, pixels: centre row
  double theta = 0.0;  // from V to H about A, radians: about -pi/2, +pi/2 for a mirrored image
};

InternalModel internal_model(const Eigen::Vector3d& a, const Eigen::Vector3d& h,
                             const Eigen::Vector3d& v);

// d(Hs, Hc, Vs, Vc, Theta)/d(C, A, H, V)
Eigen::Matrix<double, 5, 12> internal_jacobian(const Eigen::Vector3d& a, const Eigen::Vector3d& h,
                                               const Eigen::Vector3d& v);

// C, A, H and V of any model.
geometry::Cahv linear_part(const geometry::CameraModel& model);

}  // namespace dottrack::config
