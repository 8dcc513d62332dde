#pragma once
// Where a round dot shows, exactly.

#include <Eigen/Core>
#include <optional>

#include "app/core/geometry/camera_model.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::workstation {

// The middle of a disc's picture: not where its middle is projected to, but off by up to a tenth of
// a pixel for dots that are near, large and seen aslant. Nothing where the model sees no part of
// it.
std::optional<Eigen::Vector2d> disc_image_centre(const geometry::CameraModel& model,
                                                 const Eigen::Vector3d& centre_m,
                                                 const Eigen::Vector3d& normal, double radius_m);

// From the projection of a dot's middle to the middle of its picture, in this pose; zero where the
// target does not say how the dot faces.
Eigen::Vector2d eccentricity_px(const geometry::CameraModel& model, const core::TargetDot& dot,
                                const core::Pose& pose);

}  // namespace dottrack::workstation
