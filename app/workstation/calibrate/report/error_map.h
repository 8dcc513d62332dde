#pragma once
// How well the calibrated cameras will place a dot, over the hall.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "app/workstation/calibrate/fit/calibration.h"

namespace dottrack::calibrate {

// Cells of a horizontal plane, rows along y from its low end.
struct ErrorMap {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();  // corner, world
  double height_m = 0.0;                            // z
  double step_m = 1.0;                              // width of a cell
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> error_m;       // root of the expected square; NaN: fewer than two cameras
  std::vector<std::size_t> cameras;  // that see the cell's middle

  Eigen::Vector3d middle(std::size_t column, std::size_t row) const;
  double worst_m() const;  // of those that are seen; 0 if none is
  double median_m() const;
};

// Standard deviations that a camera's model causes in its image of a point, both coordinates;
// pixels squared. False where the camera does not see it.
bool model_covariance(const CameraCalibration& camera, const Eigen::Vector3d& point_m,
                      Eigen::Matrix2d& covariance_px2, geometry::ProjectionJacobian& by_point);

// From the noise of the images and the uncertainty of the models, with what these have in common
// from their survey. Over the surveyed dots' extent, at `height_m`; nothing hides anything.
ErrorMap error_map(const Calibration& calibration, std::span<const SurveyedDot> dots,
                   double height_m);

}  // namespace dottrack::calibrate
