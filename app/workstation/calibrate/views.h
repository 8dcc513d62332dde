#pragma once
// What a calibration is made from: surveyed dots and where cameras saw them.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/core/geometry/camera_model.h"

namespace dottrack::calibrate {

// A dot whose place was surveyed. Dots that stand for good have no tick; the dots of a target that
// is carried from place to place are listed anew for each tick in which it stood there.
struct SurveyedDot {
  std::string name;                                        // as the file has it
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    // world
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Constant(0);  // of the survey; 0: exact
  double diameter_m = 0.0;                                 // 0: not known
  std::optional<Eigen::Vector3d> normal;                   // unit, world
  std::optional<std::size_t> tick;                         // nothing: seen in every image
};

// A dot in one image.
struct Observation {
  std::size_t dot = 0;  // index into the survey
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0.1;  // of each coordinate
};

// What one camera saw, and what is known of it beforehand.
struct CameraViews {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  std::vector<Observation> observations;
  std::optional<geometry::CameraModel> approximate;  // a model, not exact
  std::optional<Eigen::Vector3d> near_m;             // only its place, world, not exact
};

}  // namespace dottrack::calibrate
