#pragma once
// From the covariance of all models together to how their errors go together.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/config/joint_covariance.h"
#include "app/core/model_correlations.h"

namespace dottrack::config {

// What is known of a camera's model.
struct ModelReading {
  Eigen::MatrixXd covariance;  // S of its file; empty without
  Eigen::MatrixXd of_vectors;  // a change of the vectors in its model errors (set_model_errors)
};

// Sets the correlations of the rig's model errors; names and readings in the order of the cameras.
// Returns the cameras that the joint covariance is not of: their S is not in it.
std::vector<std::size_t> correlate(const JointCovariance& joint, std::span<const std::string> names,
                                   std::span<const ModelReading> readings,
                                   core::ModelCorrelations& correlations);

}  // namespace dottrack::config
