#pragma once
// How far a flat dot's middle in the image is from where its centre is shown.

#include <Eigen/Core>

#include "app/core/geometry/camera_model.h"
#include "app/workstation/calibrate/labelling/growth.h"

namespace dottrack::calibrate {

// The centroid of the area that a disc covers in the image, less its centre's pixel: a dot's nearer
// half is shown larger. 0.03 px for a dot of 10 cm at 5 m, 45 degrees, 500 px; it grows with the
// square of the diameter. Zero where the camera does not see all of the disc's rim.
Eigen::Vector2d eccentricity_px(const geometry::CameraModel& model, const Eigen::Vector3d& centre_m,
                                const Eigen::Vector3d& normal, double radius_m);

// Of the labelled dot, seen as the sketch has it. Its normal, where the survey has none, is that of
// the plane through its neighbours; its radius, where the survey has no diameter, what the blob
// says. Zero where there is no such plane.
Eigen::Vector2d eccentricity_px(const Scene& scene, const SurveyIndex& survey,
                                const Growth& labelling, int dot);

}  // namespace dottrack::calibrate
