#pragma once
// A camera model as the vectors it is made of, C A H V [O R [E]], and how they and its pixels
// change.

#include <Eigen/Core>

#include "app/core/geometry/camera_model.h"

namespace dottrack::calibrate {

// Vector `index` of the model, below parts(model).
Eigen::Vector3d part(const geometry::CameraModel& model, int index);
void set_part(geometry::CameraModel& model, int index, const Eigen::Vector3d& value);
int parts(const geometry::CameraModel& model);

// A, H, V and O turn with the camera.
constexpr bool is_direction(int index) {
  return index >= 1 && index <= 4;
}

// d(C A H V [O R [E]]) / d(turn, shift): radians and metres, both in the world.
Eigen::MatrixXd vectors_by_pose(const geometry::CameraModel& model);

// d(pixel) / d(C A H V [O R [E]]), by differences.
Eigen::MatrixXd pixel_by_vectors(const geometry::CameraModel& model,
                                 const Eigen::Vector3d& point_m);

}  // namespace dottrack::calibrate
