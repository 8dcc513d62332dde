#pragma once
// Where a camera stands that somebody has knocked against, from a run that the others tracked.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "app/core/geometry/camera_model.h"
#include "app/core/rig.h"
#include "app/workstation/survey/run_file.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

// The camera carried by shift_m and turned about its own centre by turn_rad, a rotation vector;
// both in the world. Its lens stays as it is.
geometry::CameraModel carried(const geometry::CameraModel& model, const Eigen::Vector3d& turn_rad,
                              const Eigen::Vector3d& shift_m);

struct CameraRepair {
  geometry::CameraModel model;
  // Of C A H V [O R [E]], as JPL's file has it: what is known of the lens as before, the pose as
  // the run tells it.
  Eigen::MatrixXd covariance;
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  // from the old model, world axes
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_sigma_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_sigma_m = Eigen::Vector3d::Zero();
  double rms_before_px = 0.0;  // of the same views, under the old model
  double rms_px = 0.0;         // of a coordinate
  std::size_t ticks = 0;
  std::size_t views = 0;
  std::size_t odd_views = 0;  // that hardly counted
};

// Robust least squares over the camera's position and attitude. `ticks`: of which the views of
// this camera count that the poses do not rest on (RecordedView::moved). `covariance_before`: of
// the old model, where it is known. An error says what there is too little of.
Result<CameraRepair> repair_camera(const core::Rig& rig, std::size_t camera,
                                   std::span<const workstation::RecordedTick> ticks,
                                   const std::optional<Eigen::MatrixXd>& covariance_before);

}  // namespace dottrack::calibrate
