#pragma once
// From a camera model's covariance to the ways in which the model may be wrong.

#include <Eigen/Core>

#include "app/core/rig.h"

namespace dottrack::config {

// Sets camera.model_errors: the model, wrong by one standard deviation in each of the independent
// ways that `covariance` (S of its file: C A H V [O R [E]]) leaves open, the one that moves
// pictures most first; those that move them by less than 0.002 px RMS, over the image and the
// camera's distances, are left out. The camera's model, image size and distances are set before.
// Returns how to read a change of the model's vectors in these errors: one row each.
Eigen::MatrixXd set_model_errors(const Eigen::MatrixXd& covariance, core::Camera& camera);

}  // namespace dottrack::config
